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
  const fs::path path = find_reach_case(places, name);
  const auto text = read_file(path);
  if (!text.has_value()) {
    return Error{Error::Code::unreadable,
                 name + ": wanted `air3d`, the name of a case in data/reach, or a file; " +
                     text.error().message};
  }
  const auto found = reach::parse_avoidance_case(text.value(), path.string());
  if (!found.has_value()) {
    return found.error();
  }
  return reach::avoidance_problem(found.value());
}

}  // namespace saca::app
