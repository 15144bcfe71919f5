#pragma once

#include <filesystem>
#include <string>

#include "myoid/files/folder_lock.h"

namespace myoid::cli {

/// Keeps a folder for this process until the program ends. Throws as FolderLock does.
recording::FolderLock& hold_folder(const std::filesystem::path& folder);

/// Marks the results in all held folders as whole. Without this call a folder that was empty
/// belongs to the unfinished command, which takes the folder over when the user repeats it.
void finish_folders();

/// A clause on the held folders: "every file in out is whole, and ..." where a folder has results,
/// else "nothing was written into out"; empty where no folder is held.
[[nodiscard]] std::string contents_of_folders();

/// Gives back a folder that `hold_folder` keeps.
void release_folder(const std::filesystem::path& folder);

}  // namespace myoid::cli
