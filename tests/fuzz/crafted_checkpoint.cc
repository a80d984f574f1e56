#include "tests/fuzz/crafted_checkpoint.h"

#include "dem/io/seal.h"
#include "dem/io/state/assembly_state.h"
#include "dem/io/state/checkpoint.h"
#include "tests/fuzz/crafted_hdf5.h"
#include "tests/support/assembly_with_everything.h"

#include <algorithm>
#include <type_traits>

namespace mergel::fuzz {

namespace {

hid_t type_of(double)
{
  return H5T_NATIVE_DOUBLE;
}
hid_t type_of(std::uint64_t)
{
  return H5T_NATIVE_UINT64;
}
hid_t type_of(std::uint32_t)
{
  return H5T_NATIVE_UINT32;
}
hid_t type_of(std::int32_t)
{
  return H5T_NATIVE_INT32;
}
hid_t type_of(std::int16_t)
{
  return H5T_NATIVE_INT16;
}
hid_t type_of(char)
{
  return H5T_NATIVE_CHAR;
}

/// Numbers are exact, except sums beyond 2^53.
std::vector<CraftedArray> arrays_of(const dem::State& state)
{
  std::vector<CraftedArray> arrays;
  for (const auto& [name, array] : state.arrays()) {
    CraftedArray a{name, 0, {array.rows()}, {}};
    if (array.columns > 1) a.size.push_back(array.columns);
    std::visit(
        [&a](const auto& v) {
          a.type = type_of(typename std::decay_t<decltype(v)>::value_type{});
          a.values.assign(v.begin(), v.end());
        },
        array.values);
    arrays.push_back(std::move(a));
  }
  return arrays;
}

} // namespace

void write_good_checkpoint(const std::filesystem::path& file)
{
  dem::Assembly assembly = dem::test::assembly_with_everything();
  for (int k = 0; k < 100; ++k) dem::test::step_with_everything(assembly, 1e-6);
  dem::State state(0);
  dem::save(state, assembly);
  dem::write_checkpoint(file, {"0.1.0", "pile", "driving", "set a = 1\n", 100, 1e-4},
                        std::move(state), dem::Communicator());
}

void craft_checkpoint(const std::filesystem::path& file, const std::string& bytes)
{
  static const std::vector<CraftedArray> good = [&] {
    write_good_checkpoint(file);
    return arrays_of(dem::read_checkpoint(file).state);
  }();
  std::vector<CraftedArray> arrays = good;
  std::string choices = bytes.empty() ? bytes : bytes.substr(1);
  const std::size_t first = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]);
  if (first == 255)
    for (const CraftedArray& a : arrays) choices.insert(0, n_choices(a), '\0');
  else
    std::rotate(arrays.begin(),
                arrays.begin() + static_cast<std::ptrdiff_t>(first % good.size()),
                arrays.end());
  craft_hdf5(file, arrays,
             {{"format", 0, 0.0, "mergel checkpoint"}, {"version", H5T_NATIVE_INT, 4.0}},
             choices);
  seal_crafted(file, {"checkpoint", "64-bit sum", "", dem::sum_of_words});
}

} // namespace mergel::fuzz
