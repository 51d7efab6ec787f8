#include "apps/saca/within.h"

#include <fmt/core.h>

#include <charconv>
#include <string>

namespace saca::app {

CLI::Validator within(double low, double high) {
  const std::string range = fmt::format("in [{:g} - {:g}]", low, high);
  const auto complaint = [=](const std::string& text) {
    double value = 0.0;
    const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = problem == std::errc() && rest == text.data() + text.size();
    return number && value >= low && value <= high
               ? std::string()
               : fmt::format("want a number {}, got {}", range, text);
  };
  return {complaint, "FLOAT " + range};
}

}  // namespace saca::app
