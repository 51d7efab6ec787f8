#include "saca/lab/vehicle_study/physics_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace saca::vehicle_study {
namespace {

using nlohmann::json;
using verification::Figure;

int num_outside(const std::vector<Figure>& figures) {
  return static_cast<int>(std::count_if(figures.begin(), figures.end(),
                                        [](const Figure& one) { return !in_band(one); }));
}

}  // namespace

json json_of(const std::vector<Figure>& figures) {
  json all;
  for (const Figure& figure : figures) {
    all[figure.name] = figure.value;
    all[figure.name + ".low"] = figure.low;
    all[figure.name + ".high"] = figure.high;
    if (figure.reference) {
      all[figure.name + ".reference"] = *figure.reference;
    }
  }
  all["physics.outside_band"] = num_outside(figures);
  return all;
}

std::string text_of(const std::vector<Figure>& figures) {
  std::string text;
  for (const Figure& figure : figures) {
    const std::string reference =
        figure.reference ? fmt::format("{:8.3f}", *figure.reference) : "       -";
    text += fmt::format("{:48} {:9.4f}   reference {}   band {:7.3f} to {:7.3f}   {}\n",
                        figure.name, figure.value, reference, figure.low, figure.high,
                        in_band(figure) ? "inside" : "OUTSIDE");
  }
  return text + fmt::format("outside their bands: {}\n", num_outside(figures));
}

}  // namespace saca::vehicle_study
