#pragma once

#include <filesystem>

#include "myoid/files/folder_lock.h"

namespace myoid::cli {

/// Keeps a folder for this process until the program ends. Throws as FolderLock does.
recording::FolderLock& hold_folder(const std::filesystem::path& folder);

}  // namespace myoid::cli
