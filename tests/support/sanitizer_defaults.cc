/// Options of the sanitizers in a build with MERGEL_SANITIZE. They are linked into every
/// program and library, so that tests, scripts and the ranks of mpirun need no environment.
/// ASAN_OPTIONS, UBSAN_OPTIONS and LSAN_OPTIONS still override them.

extern "C" {

// A finding ends the program with another exit code than those of the program: 1 is bad
// input, 2 a failed run, and tests expect them.
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

// Open MPI 4.1 leaks 120 kB on every rank. Text that libc formats for it has no caller on
// the stack, because libc is built without frame pointers.
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
