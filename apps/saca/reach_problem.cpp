#include "apps/saca/reach_problem.h"

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/thinking/danger/avoidance_case.h"

namespace saca::app {

namespace fs = std::filesystem;

Result<levelset::Problem> find_problem(const Places& places, const std::string& name) {
  if (name == "air3d") {
    return levelset::air3d_problem(levelset::air3d_grid(101, 79, 100));
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
  const auto found = danger::parse_avoidance_case(text.value(), path.string());
  if (!found.has_value()) {
    return found.error();
  }
  return levelset::avoidance_problem(found.value());
}

}  // namespace saca::app
