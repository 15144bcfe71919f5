// glibc 2.35 gave hypot a second version, which differs in errno alone: same numbers. A program that asks for the first
// one (2.2.5, of x86-64) runs on systems with an older C library. The linker's --wrap=hypot leads every call here.
extern "C" {
double first_hypot(double x, double y);
__asm__(".symver first_hypot,hypot@GLIBC_2.2.5");
double __wrap_hypot(double x, double y);
double __wrap_hypot(double x, double y) { return first_hypot(x, y); }
}
