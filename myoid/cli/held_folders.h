#pragma once

#include <memory>
#include <string>

#include "myoid/files/result_folder.h"

namespace myoid::cli {

/// Keeps a folder for this process until the program ends.
void hold_folder(std::unique_ptr<recording::ResultFolder> folder);

/// Marks the results in all held folders as whole. Without this call a folder that was empty
/// belongs to the unfinished command, which takes the folder over when the user repeats it.
void finish_folders();

/// Returns a clause on the held folders: "every file in out is whole, and ..." for a folder with
/// results, else "nothing was written into out"; empty if no folder is held.
[[nodiscard]] std::string contents_of_folders();

/// Gives all folders back. Bad input leaves no empty folder that the program made.
void release_folders();

}  // namespace myoid::cli
