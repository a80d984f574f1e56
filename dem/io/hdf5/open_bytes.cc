#include "dem/io/hdf5/open_bytes.h"

namespace mergel::dem::hdf5 {

namespace {

constexpr std::size_t growth = 1 << 20; ///< of a file in memory; HDF5 requires a value

/// Let HDF5 read the bytes of a file in place, without two copies of them.
void read_in_place(hid_t access, std::string& bytes)
{
  H5FD_file_image_callbacks_t calls = {};
  calls.udata = &bytes;
  calls.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* held) -> void* {
    auto& all = *static_cast<std::string*>(held);
    return size == all.size() ? all.data() : nullptr;
  };
  calls.image_memcpy = [](void* to, const void*, std::size_t, H5FD_file_image_op_t, void*) {
    return to; // the bytes are there already
  };
  calls.image_realloc = [](void*, std::size_t, H5FD_file_image_op_t, void*) -> void* {
    return nullptr; // a file that is only read does not grow
  };
  calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  calls.udata_copy = [](void* held) { return held; };
  calls.udata_free = [](void*) -> herr_t { return 0; };
  if (H5Pset_file_image_callbacks(access, &calls) < 0 ||
      H5Pset_file_image(access, bytes.data(), bytes.size()) < 0)
    throw NumericalError("HDF5 cannot read from memory");
}

hid_t opened(hid_t access, std::string& bytes, const std::filesystem::path& path)
{
  H5Pset_fapl_core(access, growth, false);
  read_in_place(access, bytes);
  // HDF5 needs a name that no file has: no file can lie below another file.
  return H5Fopen((path / "in memory").c_str(), H5F_ACC_RDONLY, access);
}

} // namespace

OpenBytes::OpenBytes(std::string& bytes, const std::filesystem::path& path)
    : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "choose an access"),
      file_(opened(access_, bytes, path), H5Fclose, "open it")
{
}

} // namespace mergel::dem::hdf5
