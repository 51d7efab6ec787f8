#pragma once

#include <functional>
#include <string>

namespace saca::benchmarks {

/// Takes in a few words what a long benchmark is at: nothing of it may be timed then.
using Note = std::function<void(const std::string& what)>;

}  // namespace saca::benchmarks
