/// A key that chooses one law of a list, and the keys of each law.
#pragma once

#include "apps/case/case_file.h"

#include <tuple>
#include <utility>
#include <variant>

namespace mergel::apps {

/// All laws of a std::variant with their keys, and which of them is chosen. A law needs
/// `static const char* name` and a function declare_law(CaseFile&, Law&) that declares its
/// keys and sets those without a default to `unset`; without it this does not compile.
template <class AnyLaw>
struct LawKeys;

template <class... Laws>
struct LawKeys<std::variant<Laws...>> {
  std::tuple<Laws...> laws;
  std::size_t index = 0; ///< of the chosen law in the list; the first one by default

  /// The chosen law with its parameters.
  std::variant<Laws...> chosen() const
  {
    return chosen([](const auto&) {});
  }
  /// The same after change(law), for what the laws share.
  template <class Change>
  std::variant<Laws...> chosen(Change&& change) const
  {
    std::variant<Laws...> law;
    std::size_t k = 0;
    const auto take = [&](auto candidate) {
      if (k++ != index) return;
      change(candidate);
      law = candidate;
    };
    (take(std::get<Laws>(laws)), ...);
    return law;
  }
};

/// Declare the choice `key` in the open section.
template <class... Laws>
void declare_choice(CaseFile& file, const std::string& key,
                    LawKeys<std::variant<Laws...>>& k, const std::string& sentence)
{
  std::size_t n = 0;
  file.choice(key, k.index,
              std::vector<std::pair<std::string, std::size_t>>{{Laws::name, n++}...},
              sentence);
}

/// Declare the keys of each law, valid where it is chosen.
template <class... Laws>
void declare_laws(CaseFile& file, const std::string& key, LawKeys<std::variant<Laws...>>& k)
{
  const auto declare_one = [&](auto& law) {
    const auto only = file.only_if(key, {std::decay_t<decltype(law)>::name});
    declare_law(file, law);
  };
  (declare_one(std::get<Laws>(k.laws)), ...);
}

} // namespace mergel::apps
