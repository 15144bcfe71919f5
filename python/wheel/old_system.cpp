// Functions that objects compiled with new headers call, and that the old libraries of a wheel's module lack.
#include <cstdlib>

#include <fmt/format-inl.h>
#include <sys/random.h>

// fmt's library, whose own one needs a newer C++ library.
template char fmt::detail::decimal_point_impl<char>(fmt::detail::locale_ref);
template fmt::detail::thousands_sep_result<char> fmt::detail::thousands_sep_impl<char>(fmt::detail::locale_ref);
template void fmt::detail::buffer<char>::append(const char*, const char*);
template void fmt::detail::vformat_to(fmt::detail::buffer<char>&,
                                      fmt::string_view,
                                      fmt::basic_format_args<FMT_BUFFER_CONTEXT(char)>,
                                      fmt::detail::locale_ref);

extern "C" {
// glibc 2.32: shared pointers count without locks while it is true. False is right for every process.
extern char __libc_single_threaded;
char __libc_single_threaded = 0;

// glibc 2.36: std::random_device of GCC 12 takes it.
unsigned arc4random() noexcept {
  unsigned number = 0;
  if (getentropy(&number, sizeof number) != 0) std::abort();
  return number;
}
}
