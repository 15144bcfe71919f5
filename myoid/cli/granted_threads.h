#pragma once

namespace myoid::cli {

/// How many threads of `wanted` the system lets this process have at the same time, beside the one
/// that calls: all are made, wait for each other and end. Limits on processes (`ulimit -u`, a
/// container's pids) and on memory (`ulimit -v`) bind here.
[[nodiscard]] int granted_threads(int wanted);

}  // namespace myoid::cli
