# Writes the source of dem/version.h, if it is another one than that of the last build.
#
# usage: cmake -DROOT=. -DOUT=version.cc -DNUMBER=0.1.0 -DCOMPILER=... -DLIBRARIES=... -P version.cmake
set(git git -c safe.directory=* -C ${ROOT})
set(commit "")
if(EXISTS ${ROOT}/.git) # not that of a folder above
  execute_process(COMMAND ${git} log -1 --abbrev=12 --format=%h,%cs
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
set(date "")
set(is_changed false)
if(commit MATCHES "^([0-9a-f]+),(.*)$")
  set(commit ${CMAKE_MATCH_1})
  set(date ${CMAKE_MATCH_2})
  execute_process(COMMAND ${git} diff --quiet HEAD RESULT_VARIABLE differs OUTPUT_QUIET ERROR_QUIET)
  if(NOT differs EQUAL 0)
    set(is_changed true)
  endif()
else()
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY NEWLINE_STYLE UNIX CONTENT [[
/// Written by dem/version.cmake.
#include "dem/version.h"

namespace mergel::dem {

const Version& version()
{
  static const Version v{"@NUMBER@", "@commit@", "@date@",
                         @is_changed@, "@COMPILER@", "@LIBRARIES@"};
  return v;
}

std::string program_text()
{
  const Version& v = version();
  std::string text = std::string("mergel ") + v.number + ", commit " + v.commit;
  if (*v.date) text += std::string(" of ") + v.date;
  return v.is_changed ? text + ", changed since" : text;
}

} // namespace mergel::dem
]])
