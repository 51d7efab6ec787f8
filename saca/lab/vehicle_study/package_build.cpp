#include "saca/lab/vehicle_study/package_build.h"

#include <fmt/core.h>

#include "saca/base/core/file.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/onboard/reflex/vehicle_package.h"

namespace saca::vehicle_study {

Result<std::string> package_of(const PackageParts& parts) {
  const std::string& name = parts.car_name;
  if (name.size() > reflex::longest_package_name) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want a car's name of at most {} bytes, got {}", name,
                             reflex::longest_package_name, name.size())};
  }
  const auto atlas = read_file(parts.atlas, many_bytes);
  const auto right = atlas.has_value()
                         ? atlas::parse_atlas(atlas.value(), parts.atlas.string(), *parts.car)
                         : atlas.error();
  if (!right.has_value()) {
    return Error{right.error().code, right.error().message + parts.remedy};
  }
  return reflex::vehicle_package_bytes(name, *parts.car, *parts.harm, atlas.value());
}

}  // namespace saca::vehicle_study
