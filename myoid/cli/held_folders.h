#pragma once

#include <filesystem>
#include <string>

#include "myoid/files/folder_lock.h"

namespace myoid::cli {

/// Keeps a folder for this process until the program ends. Throws as FolderLock does.
recording::FolderLock& hold_folder(const std::filesystem::path& folder);

/// The results in all folders that are held are whole. Without this call a folder that was empty
/// stays the unfinished command's, which takes it over when it is given again.
void finish_folders();

/// A clause on the folders that are held: "every file in out is whole, and ..." where results are
/// in it, else "nothing was written into out"; empty where no folder is held.
[[nodiscard]] std::string contents_of_folders();

/// Gives back a folder that `hold_folder` keeps.
void release_folder(const std::filesystem::path& folder);

}  // namespace myoid::cli
