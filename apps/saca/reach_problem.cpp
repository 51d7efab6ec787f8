#include "apps/saca/reach_problem.h"

#include <filesystem>

#include "saca/core/file.h"
#include "saca/reach/avoidance_case.h"

namespace saca::app {

namespace fs = std::filesystem;

Result<reach::Problem> find_problem(const Places& places, const std::string& name) {
  if (name == "air3d") {
    return reach::air3d_problem(reach::air3d_grid(101, 79, 100));
  }
  const auto found_file = find_reach_case(places, name);
  if (!found_file.has_value()) {
    return Error{found_file.error().code, found_file.error().message + ", or air3d"};
  }
  const fs::path& path = found_file.value();
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  const auto found = reach::parse_avoidance_case(text.value(), path.string());
  if (!found.has_value()) {
    return found.error();
  }
  return reach::avoidance_problem(found.value());
}

}  // namespace saca::app
