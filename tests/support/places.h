#pragma once

#include <filesystem>

namespace myoid::test {

/// The folder of the checkout. Only places.cpp is compiled with its name, so that the objects of
/// two checkouts are equal and a compiler cache serves both.
std::filesystem::path source_dir();

/// The folder of the shared real recordings: MYOID_DATA, or else `../shared/data` beside the
/// checkout. They are not part of the project and may be absent.
std::filesystem::path data_folder();

}  // namespace myoid::test
