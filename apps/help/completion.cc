#include "apps/help/completion.h"

#include "apps/case/case_file.h"
#include "apps/case/words.h"
#include "apps/help/pages.h"

#include <algorithm>
#include <regex>
#include <set>

namespace mergel::apps {

namespace {

/// The options that a page explains, each at the start of a line.
std::string options_in(const std::string& page)
{
  static const std::regex option("(?:^|\n) +(--[a-z][a-z-]*)");
  std::set<std::string> names{"--help"};
  for (std::sregex_iterator at(page.begin(), page.end(), option), end; at != end; ++at)
    names.insert((*at)[1].str());
  if (names.contains("--template")) names.insert("--json"); // with --help
  return joined({names.begin(), names.end()}, " ");
}

/// A word of a script in single quotes.
std::string quoted(const std::string& text)
{
  return "'" + std::regex_replace(text, std::regex("'"), "'\\''") + "'";
}

const char* const functions = R"bash(
_mergel_reply() # WORD...: those that begin as the present word does, quoted where need be
{
  local word start=${current#[\"\']} is_open=
  [ "$start" = "$current" ] || is_open=1
  for word in "$@"; do
    case $word in "$start"*) ;; *) continue ;; esac
    if [ "$is_open" ]; then COMPREPLY+=("$word"); else COMPREPLY+=("$(printf %q "$word")"); fi
  done
}

_mergel_files() # PATTERN: folders, and files of this pattern
{
  local IFS=$'\n'
  compopt -o filenames 2>/dev/null
  COMPREPLY=($(compgen -d -- "$current") $(compgen -f -X "!$1" -- "$current"))
}

_mergel()
{
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} job=${COMP_WORDS[1]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    _mergel_reply $_mergel_jobs help man version completion --help --version
    return
  fi
  case $job in
    help | man) _mergel_reply $_mergel_jobs; return ;;
    completion) _mergel_reply bash; return ;;
  esac
  case $before in
    --set)
      local IFS=$'\n'
      compopt -o nospace 2>/dev/null
      _mergel_reply $(_mergel_keys "$job")
      return ;;
    --restart) _mergel_files '*.h5'; return ;;
    --output | --write-block | --checkpoint) _mergel_files '*'; return ;;
    --walltime) _mergel_reply 1h 4h 12h 23h; return ;;
  esac
  case $current in
    -*) _mergel_reply $(_mergel_options "$job"); return ;;
  esac
  case $job in
    info | compare) _mergel_files '*' ;;
    *) _mergel_files '*.prm' ;;
  esac
}

complete -F _mergel mergel
)bash";

} // namespace

std::string bash_completion()
{
  std::string names, options, keys;
  for (const Job& job : jobs) {
    const std::string name = job.name;
    names += (names.empty() ? "" : " ") + name;
    options += "    " + name + ") echo " + quoted(options_in(options_of(job))) + " ;;\n";
    if (!job.reads_case()) continue;
    keys += "    " + name + ") printf '%s\\n'";
    job.keys([&](const CaseFile& file) {
      std::set<std::string> seen;
      for (const CaseFile::Description& key : file.descriptions())
        if (const std::string word = key.section + "/" + key.name + "=";
            seen.insert(word).second)
          keys += " \\\n      " + quoted(word);
    });
    keys += " ;;\n";
  }
  return "# Completion for bash, written by mergel completion bash.\n_mergel_jobs='" +
         names + "'\n\n_mergel_options() # JOB\n{\n  case $1 in\n" + options +
         "  esac\n}\n\n_mergel_keys() # JOB\n{\n  case $1 in\n" + keys + "  esac\n}\n" +
         functions;
}

} // namespace mergel::apps
