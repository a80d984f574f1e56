#include "apps/help/man_page.h"

#include "apps/case/case_file.h"
#include "apps/case/words.h"
#include "apps/help/pages.h"
#include "dem/version.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace mergel::apps {

namespace {

/// The text as man reads it: a backslash, hyphens that stay hyphens, no line that is a request.
std::string plain(const std::string& text)
{
  std::string result;
  bool is_first = true; // of its line
  for (const char c : text) {
    if (is_first && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '`')
      result += "\\(ga";
    else if (c == '\'')
      result += "\\(aq";
    else if (c == '^')
      result += "\\(ha";
    else if (c == '~')
      result += "\\(ti";
    else
      result += c;
    is_first = c == '\n';
  }
  return result;
}

std::string section(const std::string& name)
{
  return ".SH " + name + "\n";
}

/// Lines as they are.
std::string as_it_is(const std::string& text)
{
  return ".nf\n" + plain(text) + (text.ends_with('\n') ? "" : "\n") + ".fi\n";
}

std::string heading(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  const dem::Version& v = dem::version();
  return ".TH " + name + " 1 \"" + v.date + "\" \"mergel " + v.number +
         "\" \"mergel\"\n.nh\n.ad l\n";
}

std::string exit_status()
{
  return section("EXIT STATUS") +
         "0 done; 1 bad input; 2 numerical or system failure, or stopped behind a "
         "checkpoint; 3 a bug.\n";
}

/// One key and its meaning.
std::string entry(const CaseFile::Description& key)
{
  const std::string standard = key.is_required        ? "required"
                               : !key.rule.empty()    ? "default: " + key.rule
                               : key.standard.empty() ? "default: none"
                                                      : "default: " + key.standard;
  const std::string condition = key.condition.empty() ? "" : key.condition + ": ";
  const std::string exception =
      key.not_needed.empty() ? "" : " Not needed where " + key.not_needed + ".";
  return ".TP\n.B " + plain(key.name) + "\n" + plain(condition + key.sentence + exception) +
         "\n.br\n" +
         plain((key.unit == "-" ? "" : "unit " + key.unit + "; ") + standard + "; " +
               key.allowed) +
         "\n";
}

} // namespace

std::string man_page()
{
  std::string text = heading("mergel") + section("NAME") +
                     "mergel \\- coupled DEM-FEM solver for weak, porous, bonded rock\n" +
                     section("SYNOPSIS");
  for (const Job& job : jobs)
    text += (&job == jobs.data() ? "" : ".br\n") + (".B mergel " + std::string(job.name)) +
            "\n" + plain(job.arguments) + "\n";
  text += section("DESCRIPTION") +
          "A case is a text file of sections and keys; every value carries its unit. A job "
          "reads it and writes its results into a folder of their own. Results have the "
          "same bits on any number of ranks, and after a restart.\n" +
          section("JOBS");
  for (const Job& job : jobs)
    text += ".TP\n.BR mergel\\-" + std::string(job.name) + " (1)\n" + plain(job.sentence) +
            "\n";
  text += section("OTHER COMMANDS") +
          ".TP\n.B mergel help \\fR[\\fIJOB\\fR]\nThese pages, through $PAGER on a "
          "terminal.\n"
          ".TP\n.B mergel version\nVersion, commit, compiler and libraries.\n"
          ".TP\n.B mergel completion bash\nCompletion for the shell.\n" +
          section("ENVIRONMENT") +
          ".TP\n.B PAGER\nThe program that shows long pages; less "
          "without it.\n";
  return text + exit_status();
}

std::string man_page(const Job& job)
{
  const std::string name = "mergel-" + std::string(job.name);
  std::string text = heading(name) + section("NAME") + plain(name) + " \\- " +
                     plain(job.sentence) + "\n" + section("SYNOPSIS") + ".B mergel " +
                     job.name + "\n" + plain(job.arguments) + "\n" + section("OPTIONS") +
                     as_it_is(options_of(job));
  if (job.reads_case()) {
    text += section("KEYS") +
            "Keys of the case, by section. A value is written with its unit; any unit of "
            "its dimension is accepted.\n";
    std::ostringstream remarks;
    if (job.help) job.help(remarks);
    if (!remarks.str().empty()) text += ".PP\n" + plain(remarks.str());
    std::string open;
    job.keys([&](const CaseFile& file) {
      for (const CaseFile::Description& key : file.descriptions()) {
        if (key.section != open) text += ".SS " + plain(key.section) + "\n";
        open = key.section;
        text += entry(key);
      }
    });
  }
  return text + exit_status() + section("SEE ALSO") + ".BR mergel (1)\n";
}

} // namespace mergel::apps
