#include "saca/lab/banks/recall_calibration.h"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "saca/lab/banks/bank_files.h"
#include "saca/thinking/memory/experience.h"

namespace saca::banks {
namespace {

using eval::Transfer;
using eval::TransferFigures;

/// A range of confidence that has a gate (memory::gate).
struct ConfidenceRange {
  const char* key;
  const char* words;
  double from;
  double to;
};
constexpr std::array<ConfidenceRange, 3> confidence_ranges{{{"above_0.9", "above 0.9", 0.9, 1.0},
                                                            {"0.7_to_0.9", "0.7 to 0.9", 0.7, 0.9},
                                                            {"below_0.7", "up to 0.7", -1.0, 0.7}}};

void add_share(nlohmann::json& out, const std::string& key, const learned_danger::Share& share) {
  const eval::ShareInterval interval = eval::interval_of(share);
  out[key] = share.value();
  out[key + ".lo"] = interval.low;
  out[key + ".hi"] = interval.high;
  out[key + ".n"] = share.of;
}

/// @param place  "memory.transfer.within"
void add_transfers(nlohmann::json& out, const std::string& place,
                   const std::vector<Transfer>& all) {
  out[place + ".queries"] = all.size();
  for (const ConfidenceRange& range : confidence_ranges) {
    const TransferFigures figures = eval::transfer_figures(all, range.from, range.to);
    const std::string key = place + "." + range.key;
    out[key + ".coverage"] = figures.coverage;
    add_share(out, key + ".in_truth", figures.in_truth);
    add_share(out, key + ".as_told", figures.as_told);
    add_share(out, key + ".random_one", figures.random_one);
    add_share(out, key + ".braking", figures.braking);
  }
}

std::string share_text(const learned_danger::Share& share) {
  const eval::ShareInterval interval = eval::interval_of(share);
  return share.of == 0 ? "-"
                       : fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100.0 * share.value(),
                                     100.0 * interval.low, 100.0 * interval.high);
}

std::string transfers_text(const std::string& what, const std::vector<Transfer>& all) {
  std::string text = fmt::format(
      "\n{}: {} queries in which the choice matters\n{:12} {:>9} {:>24} {:>24} {:>24} {:>24}\n",
      what, all.size(), "confidence", "coverage", "as good as the best", "as was expected",
      "of a random case", "braking");
  for (const ConfidenceRange& range : confidence_ranges) {
    const TransferFigures figures = eval::transfer_figures(all, range.from, range.to);
    text += fmt::format("{:12} {:8.1f} % {:>24} {:>24} {:>24} {:>24}\n", range.words,
                        100.0 * figures.coverage, share_text(figures.in_truth),
                        share_text(figures.as_told), share_text(figures.random_one),
                        share_text(figures.braking));
  }
  return text;
}

}  // namespace

Result<CalibrationCases> read_calibration_cases(const std::string& file,
                                                const std::vector<std::string>& check_files) {
  auto cases = read_cases(file);
  if (!cases.has_value()) {
    return cases.error();
  }
  if (cases.value().empty()) {
    return Error{Error::Code::malformed, file + ": want cases, got none"};
  }
  auto checks = read_cases(check_files);
  if (!checks.has_value()) {
    return checks.error();
  }
  return CalibrationCases{file, std::move(cases).value(), check_files, std::move(checks).value()};
}

RecallCalibration calibrate_recalls(const CalibrationCases& cases, std::uint64_t seed,
                                    int threads) {
  RecallCalibration calibration{.file = cases.file,
                                .num_cases = cases.cases.size(),
                                .seed = seed,
                                .within = eval::transfers(cases.cases, cases.cases, seed, threads),
                                .least_shares = {{{0.98, {}}, {0.95, {}}}},
                                .check_files = {},
                                .checks = {}};
  for (LeastShare& least : calibration.least_shares) {
    least.share = eval::least_share(calibration.within, least.part);
  }
  if (!cases.check_files.empty()) {
    calibration.checks = eval::transfers(cases.cases, cases.check_cases, seed, threads);
    for (const std::string& file : cases.check_files) {
      calibration.check_files += (calibration.check_files.empty() ? "" : ", ") +
                                 std::filesystem::path(file).filename().string();
    }
  }
  return calibration;
}

nlohmann::json json_of(const RecallCalibration& calibration, const std::string& version) {
  nlohmann::json out{
      {"meta.command", fmt::format("saca memory calibrate CASES{} --seed {}",
                                   calibration.checks ? " --check CASES" : "", calibration.seed)},
      {"meta.seed", std::to_string(calibration.seed)},
      {"meta.version", version},
      {"memory.transfer.cases", calibration.num_cases}};
  add_transfers(out, "memory.transfer.within", calibration.within);
  for (const LeastShare& least : calibration.least_shares) {
    out[fmt::format("memory.transfer.least_share_for_{:.2f}", least.part)] =
        least.share ? nlohmann::json(*least.share) : nlohmann::json(nullptr);
  }
  if (calibration.checks) {
    add_transfers(out, "memory.transfer.check", *calibration.checks);
  }
  return out;
}

std::string text_of(const RecallCalibration& calibration) {
  std::string text =
      transfers_text(calibration.file + ", each held against all others", calibration.within);
  for (const LeastShare& least : calibration.least_shares) {
    text += fmt::format(
        "{:.0f} % of all recalls transfer from a share of {} on; confidence there is {}\n",
        100.0 * least.part, least.share ? fmt::format("{:.3f}", *least.share) : "none",
        least.share ? fmt::format("{:.2f}", memory::confidence_at(*least.share)) : "none");
  }
  return calibration.checks ? text + transfers_text(calibration.check_files, *calibration.checks)
                            : text;
}

}  // namespace saca::banks
