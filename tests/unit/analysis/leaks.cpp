/// What LeakSanitizer is not to report: libOSMesa 22.3 keeps about 100 bytes of each context (the framebuffer of
/// OSMesaMakeCurrent), which its interface has no call to give back. Nothing of ours is in its stacks.

extern "C" const char* __lsan_default_suppressions();  // NOLINT: the name is the sanitizer's
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so\n"; }
