/// What the sanitizers do in a build with MERGEL_SANITIZE. It is linked into every program,
/// so that tests, scripts and the ranks of mpirun need no environment; ASAN_OPTIONS,
/// UBSAN_OPTIONS and LSAN_OPTIONS still go before.

extern "C" {

// A finding ends the program with a code of its own: 1 and 2 are the program's words for
// bad input and for a run that failed, and tests expect them.
const char* __asan_default_options()
{
  return "exitcode=99";
}

const char* __ubsan_default_options()
{
  return "exitcode=99:halt_on_error=1:print_stacktrace=1";
}

const char* __lsan_default_options()
{
  return "exitcode=99:print_suppressions=0";
}

// Open MPI 4.1 leaves 120 kB behind on every rank. What libc formats for it has no caller
// on the stack, because libc is built without frame pointers.
const char* __lsan_default_suppressions()
{
  return "leak:libmpi.so\n"
         "leak:libopen-pal.so\n"
         "leak:libopen-rte.so\n"
         "leak:libpmix\n"
         "leak:libevent\n"
         "leak:libhwloc\n"
         "leak:mca_\n"
         "leak:vasprintf\n";
}

// MPI unloads its modules before leaks are looked for, and an unloaded module has no name
// that could be suppressed: keep them.
int dlclose(void*)
{
  return 0;
}
}
