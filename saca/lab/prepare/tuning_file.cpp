#include "saca/lab/prepare/tuning_file.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"

namespace saca::prepare {
namespace {

using manoeuvre::DriftDomain;
using manoeuvre::Number;
using manoeuvre::Tuning;

constexpr config::Range domain_range{0.0, manoeuvre::fastest};  // [m/s]

template <class Law, std::size_t n>
void read_law(config::Table table, const std::array<Number<Law>, n>& numbers, Law& law) {
  for (const Number<Law>& number : numbers) {
    law.*number.member = table.number(number.key, {number.min, number.max});
  }
}

std::string digits(double value) {
  std::array<char, 40> text{};
  (void)std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

template <class Law, std::size_t n>
std::string law_text(std::string_view name, const std::array<Number<Law>, n>& numbers,
                     const Law& law) {
  std::string text = "\n[" + std::string(name) + "]\n";
  for (const Number<Law>& number : numbers) {
    text += std::string(number.key) + " = " + digits(law.*number.member) + "\n";
  }
  return text;
}

template <std::size_t n>
std::string list(const std::array<double, n>& values) {
  std::string text;
  for (const double value : values) {
    std::array<char, 40> number{};
    (void)std::snprintf(number.data(), number.size(), "%g", value);
    text += (text.empty() ? "[" : ", ") + std::string(number.data());
  }
  return text + "]";
}

}  // namespace

Result<Tuning> read_tuning(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  const auto document = config::Document::parse(text.value(), path.string());
  if (!document.has_value()) {
    return document.error();
  }
  config::Table root = document.value().root();
  Tuning tuning{};
  read_law(root.table("swerve"), manoeuvre::swerve_numbers, tuning.swerve);
  const config::Table drift = root.table("drift");
  read_law(drift, manoeuvre::drift_numbers, tuning.drift);
  config::Table domain = root.table("drift_domain");
  const auto grips = domain.numbers("grip", {0.0, 1.2}, DriftDomain::grips.size());
  if (!std::equal(grips.begin(), grips.end(), DriftDomain::grips.begin(),
                  DriftDomain::grips.end())) {
    domain.reject("grip", "want " + list(DriftDomain::grips));
  }
  const auto slowest = domain.numbers("slowest_mps", domain_range, DriftDomain::grips.size());
  const auto quickest = domain.numbers("fastest_mps", domain_range, DriftDomain::grips.size());
  if (const auto error = document.value().error(); error.has_value()) {
    return *error;
  }
  std::copy(slowest.begin(), slowest.end(), tuning.domain.slowest.begin());
  std::copy(quickest.begin(), quickest.end(), tuning.domain.fastest.begin());
  return tuning;
}

std::string tuning_text(const Tuning& tuning, std::string_view comment) {
  std::string text;
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    text += end == 0 ? "#" : "# ";
    text += std::string(comment.substr(0, end)) + "\n";
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  return text + law_text("swerve", manoeuvre::swerve_numbers, tuning.swerve) +
         law_text("drift", manoeuvre::drift_numbers, tuning.drift) +
         "\n[drift_domain]  # from which speed to which, at which grip, the drift keeps its "
         "promise\n" +
         "grip = " + list(DriftDomain::grips) + "\n" +
         "slowest_mps = " + list(tuning.domain.slowest) + "\n" +
         "fastest_mps = " + list(tuning.domain.fastest) + "\n";
}

}  // namespace saca::prepare
