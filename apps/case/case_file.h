/// The case file of a run: sections of keys, each bound once to the variable it sets.
///
///     CaseFile file;
///     {
///       const auto section = file.section("Bond");
///       file.quantity("effective modulus", b.E, "Pa", positive, "Modulus, Eq. 4.");
///     }
///     file.read("pile.prm", {"Bond/effective modulus=0.63 GPa"});
///
/// The format is that of deal.II's ParameterHandler (`subsection Bond`, `set key = value`, `end`,
/// `#` for comments, `\` to continue in the next line), one file, sections not nested.
#pragma once

#include "apps/case/range.h"

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mergel::apps {

/// Whether a key may be left out of the case. A quantity or number has no default when its
/// variable is NaN.
enum class Default {
  present, ///< the variable's value at declaration
  none     ///< the user must give the key
};

/// Declare all keys, then read() once or more. The bound variables must outlive the object.
/// Every InputError is one line: place, section/key = value, what is wrong, what is
/// expected. Misuse by the program (a key declared twice, a default out of its own range)
/// throws std::logic_error.
class CaseFile {
public:
  CaseFile();
  ~CaseFile();
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;

  /// While it lives, declared keys belong to this section.
  class [[nodiscard]] Section {
  public:
    ~Section();
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

  private:
    friend CaseFile;
    explicit Section(CaseFile& file) : file_(file) {}
    CaseFile& file_;
  };

  /// Open a section, new or declared before; one at a time.
  Section section(const std::string& name);

  /// While it lives, declared keys exist only where a choice or flag of the same section has
  /// one of these values; elsewhere they would have no effect, and a case that gives them is
  /// refused. A resolved case does not hold them; one of an earlier version may, and is read
  /// without them. Two conditions that exclude each other may
  /// declare keys of the same name.
  class [[nodiscard]] Condition {
  public:
    ~Condition();
    Condition(const Condition&) = delete;
    Condition& operator=(const Condition&) = delete;

  private:
    friend CaseFile;
    explicit Condition(CaseFile& file) : file_(file) {}
    CaseFile& file_;
  };

  /// @param choice a choice or flag declared before in the open section
  /// @param values some of it; of a flag "true" or "false"
  Condition only_if(const std::string& choice, const std::vector<std::string>& values);

  /// The former name of a key of the open section: a case that gives it is refused with the
  /// present name. "former N", "present N": the same number in both.
  void former_name(const std::string& former, const std::string& key);

  /// The same for a section.
  void former_section(const std::string& former, const std::string& section);

  /// Where two cases have the text key `sum` of the open section, it alone tells whether they
  /// differ in these keys of it: a path is no identity where the content is known.
  void identified_by(const std::string& sum, const std::vector<std::string>& keys);

  /// The keys of the open section declared so far, or only these of them, may be left out where
  /// this number is zero: nothing depends on them there. It is of a section declared before.
  /// Without such a number in the case they must be given as any other.
  void not_needed_at_zero(const std::string& section, const std::string& number,
                          const std::vector<std::string>& keys = {});

  /// A number with a unit. `target` is in `si_unit`, a coherent SI unit ("Pa", "m", "rad"),
  /// and so are the bounds of `range`; help and resolved case use `shown_unit` ("mm").
  void quantity(const std::string& key, double& target, const std::string& si_unit,
                const Range& range, const std::string& sentence,
                const std::string& shown_unit = "");

  /// A number without a unit.
  void number(const std::string& key, double& target, const Range& range,
              const std::string& sentence);

  /// A quantity ("1" for a plain number) whose default follows from other keys. Where the
  /// case does not give it, `target` is NaN until derive() sets it.
  /// @param rule the default in words or as a formula, for the help: "nu/(1 - nu)"
  void derived(const std::string& key, double& target, const std::string& si_unit,
               const Range& range, const std::string& rule, const std::string& sentence,
               const std::string& shown_unit = "");

  /// Set such a key, and its value in the resolved case, unless the case gives it.
  /// @pre read() was called
  /// @throws InputError when the value is out of the range of the key
  void derive(const std::string& section, const std::string& key, double value);

  /// A whole number; the range of T (up to 2^63-1) is allowed besides `range`.
  template <std::integral T>
  void integer(const std::string& key, T& target, const Range& range,
               const std::string& sentence, Default standard = Default::present)
  {
    constexpr auto largest =
        static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    constexpr auto largest_T = static_cast<std::uint64_t>(std::numeric_limits<T>::max());
    add_integer(
        key, static_cast<std::int64_t>(target),
        {static_cast<std::int64_t>(std::numeric_limits<T>::min()),
         static_cast<std::int64_t>(largest_T < largest ? largest_T : largest)},
        [&target](std::int64_t value) { target = static_cast<T>(value); }, range, sentence,
        standard);
  }

  /// One of several names, each standing for a value of T.
  template <class T>
  void choice(const std::string& key, T& target,
              const std::vector<std::pair<std::string, T>>& options,
              const std::string& sentence, Default standard = Default::present)
  {
    std::vector<std::string> names;
    std::vector<T> values;
    std::size_t present = options.size();
    for (const auto& [name, value] : options) {
      if (present == options.size() && value == target) present = names.size();
      names.push_back(name);
      values.push_back(value);
    }
    add_choice(
        key, names, present,
        [&target, values](std::size_t which) { target = values[which]; }, sentence,
        standard);
  }

  /// One of several names.
  void choice(const std::string& key, std::string& target,
              const std::vector<std::string>& options, const std::string& sentence,
              Default standard = Default::present);

  /// true or false; yes and no are accepted too.
  void flag(const std::string& key, bool& target, const std::string& sentence);

  /// One line of text without '#' or a last '\'; may be empty unless it must be given.
  void text(const std::string& key, std::string& target, const std::string& sentence,
            Default standard = Default::present);

  /// Text keys "stem 1", "stem 2" and so on, as many as a case gives. `texts` gets those that
  /// are not empty, by their numbers. An empty one is as one that is not there.
  /// @param next sentence of all but the first
  /// @param first whether "stem 1" may be left out
  void numbered(const std::string& stem, std::map<std::size_t, std::string>& texts,
                const std::string& sentence, const std::string& next,
                Default first = Default::present);

  /// A file or folder; may be empty unless it must be given. A relative path in the case
  /// file starts at the case file's folder, one from --set, from a case in a pipe, or a
  /// default at the working directory; the target is absolute. Double quotes around it are
  /// left out. The caller checks whether it exists.
  void path(const std::string& key, std::filesystem::path& target,
            const std::string& sentence, Default standard = Default::present);

  /// Files or folders, none by default, as a list of words (apps/case/word_list.h): a name
  /// with blanks stands in double quotes. Otherwise as path().
  void paths(const std::string& key, std::vector<std::filesystem::path>& targets,
             const std::string& sentence);

  /// Read the file, then the overrides ("Section/key=value", from --set), and set every
  /// bound variable. Nothing is written anywhere.
  /// @throws InputError at the first error; bound variables are then unspecified
  void read(const std::filesystem::path& path,
            const std::vector<std::string>& overrides = {});

  /// The same where the text of the file has been read already: a pipe gives it once.
  void read(const std::filesystem::path& path, const std::string& text,
            const std::vector<std::string>& overrides);

  /// The same from the text of a resolved case instead of a file, which is continued.
  /// @param name of the text in messages
  void read_text(const std::string& text, const std::string& name,
                 const std::vector<std::string>& overrides = {});

  /// Say that the case to be read is that of a run that is continued: what the earlier
  /// resolved case holds of the content of files need not be read again.
  void continue_from(const std::string& earlier_resolved_text);
  bool is_continued() const;
  /// Value of a key in the earlier case; "" without one. @pre is_continued()
  std::string earlier_value(const std::string& section, const std::string& key) const;

  /// Whether the key was given by --set. @pre read() was called
  bool is_override(const std::string& section, const std::string& key) const;

  /// Where the value of a key comes from, for checks that span several keys:
  /// "pile.prm:14: Pile/diameter", "--set Pile/diameter", or, for the default,
  /// "pile.prm: Pile/diameter". @pre read() was called
  std::string where(const std::string& section, const std::string& key) const;

  /// Refuse the value of a key: throws InputError "<where> = <value as given>: <message>". A
  /// numbered key that the case does not give may be refused too.
  /// @pre read() was called
  [[noreturn]] void refuse(const std::string& section, const std::string& key,
                           const std::string& message) const;

  /// Set the value of a text key in the resolved case, where it was found by the program.
  /// @pre read() was called
  void resolve(const std::string& section, const std::string& key,
               const std::string& value);

  /// Whether the user gave this key (file or --set), and its condition holds.
  /// @pre read() was called
  bool is_given(const std::string& section, const std::string& key) const;

  /// Write the complete case as it was read, defaults included: a case file that sets every
  /// variable to the same bits. The same case gives the same text. An existing file is
  /// replaced.
  /// @param remarks lines that begin with '#', for the head of the file
  /// @pre read() was called; @throws NumericalError if it cannot be written
  void write_resolved(const std::filesystem::path& path,
                      const std::string& remarks = "") const;

  /// What write_resolved() writes without remarks; it begins with first_words_of_resolved.
  std::string resolved_text() const;
  static constexpr std::string_view first_words_of_resolved =
      "# The complete case of a run, defaults included.";

  /// A key whose value differs from that in an earlier resolved case; "" for one that is
  /// only in one of them.
  struct Change {
    std::string section, key, was, is;
  };
  std::vector<Change> changes_since(const std::string& earlier_resolved_text) const;

  /// Every key by section: name, unit, default, what is allowed, one sentence. 92 columns.
  void help(std::ostream& out) const;

  /// The declaration of a key.
  struct Description {
    std::string section, name;
    std::string unit;     ///< "-" without one
    std::string standard; ///< text of the default; "" without one
    std::string rule;     ///< by which a default follows from other keys; "" for none
    std::string allowed;  ///< range, choices or kind
    std::string sentence;
    std::string condition; ///< "Where sizes = table"; "" for a key that always exists
    bool is_required = false;
    bool exists_by_default = true; ///< whether its condition holds in a case of defaults
    std::string not_needed;        ///< "Specimen/coordination = 0"; "" for never
  };
  /// All keys, section by section; of numbered keys the first, and those of the case as read.
  std::vector<Description> descriptions() const;

private:
  struct Limits {
    std::int64_t lower, upper;
  };
  void add_integer(const std::string& key, std::int64_t present, Limits limits,
                   std::function<void(std::int64_t)> set, const Range& range,
                   const std::string& sentence, Default standard);
  void add_choice(const std::string& key, const std::vector<std::string>& names,
                  std::size_t present, std::function<void(std::size_t)> set,
                  const std::string& sentence, Default standard);

  void read(const std::string& text, const std::string& name,
            const std::filesystem::path& folder, const std::vector<std::string>& overrides);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace mergel::apps
