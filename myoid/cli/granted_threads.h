#pragma once

namespace myoid::cli {

/// Counts the threads, at most `wanted`, that the system grants this process at the same time
/// beside the calling one: the function makes all, lets them wait for each other, and ends them.
/// Limits on processes (`ulimit -u`, a container's pids) and on memory (`ulimit -v`) bind here.
[[nodiscard]] int granted_threads(int wanted);

}  // namespace myoid::cli
