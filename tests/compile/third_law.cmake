# A law that is added to a list but not handled everywhere must not compile; handled, it must.
#
# usage: cmake -DCXX=COMPILER -DFLAGS=... -DSOURCE=FILE -DCONCEPT=NAME -P third_law.cmake
cmake_minimum_required(VERSION 3.25)

# compile(NAME DEFINITION...): sets NAME_result and NAME_error.
function(compile name)
  execute_process(COMMAND ${CXX} -std=c++20 -fsyntax-only ${FLAGS} ${ARGN} ${SOURCE}
                  RESULT_VARIABLE result ERROR_VARIABLE error)
  set(${name}_result ${result} PARENT_SCOPE)
  set(${name}_error "${error}" PARENT_SCOPE)
endfunction()

compile(handled -DHAS_FUNCTIONS -DHAS_KEYS)
if(NOT handled_result EQUAL 0)
  message(FATAL_ERROR "${SOURCE}: a law with functions and keys does not compile:\n${handled_error}")
endif()
compile(without_function -DHAS_KEYS)
if(without_function_result EQUAL 0 OR NOT without_function_error MATCHES "${CONCEPT}")
  message(FATAL_ERROR "${SOURCE}: a law that lacks a function is not refused by ${CONCEPT}:\n"
                      "${without_function_error}")
endif()
compile(without_keys -DHAS_FUNCTIONS)
if(without_keys_result EQUAL 0 OR NOT without_keys_error MATCHES "declare_law")
  message(FATAL_ERROR "${SOURCE}: a law without keys is not refused:\n${without_keys_error}")
endif()
message(STATUS "${SOURCE}: compiles where it is handled, and only there")
