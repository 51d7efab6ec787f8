#include "saca/lab/suites/method_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "saca/base/core/csv.h"
#include "saca/base/core/suggestion.h"
#include "saca/lab/eval/methods.h"

namespace saca::suites {
namespace {

constexpr const char* usual_without_thinking =
    "saca,saca_at_t1,saca_paper,aeb,r157,cc_driver,fsm,rss,rss_steering,imitation,random,nothing,"
    "first_forecast,newest_forecast,going_on_atlas,beliefs_atlas,beliefs_rolled_out,oracle";

/// Why there is no such row with this memory, model and weights; nullptr: there is.
const char* missing_for(const eval::MethodInfo& info, const ThinkingOptions& thinking,
                        const std::string& danger) {
  switch (info.needs) {
    case eval::Needs::memory:
      return thinking.memory.empty() ? "--memory FILE" : nullptr;
    case eval::Needs::model:
      return thinking.model == "off" ? "--llm MODEL" : nullptr;
    case eval::Needs::untuned:
      return thinking.untuned.empty() ? "--untuned MODEL" : nullptr;
    case eval::Needs::danger:
      return danger.empty() ? "--danger WEIGHTS" : nullptr;
    case eval::Needs::imitator:  // it is shipped
    case eval::Needs::nothing:
      return nullptr;
  }
  return nullptr;
}

}  // namespace

std::optional<std::size_t> index_of(const std::vector<std::string>& methods,
                                    std::string_view method) {
  const auto found = std::find(methods.begin(), methods.end(), method);
  return found == methods.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - methods.begin()));
}

std::string joined(const std::vector<std::string>& methods) {
  std::string all;
  for (const std::string& method : methods) {
    all += (all.empty() ? "" : ",") + method;
  }
  return all;
}

Result<std::vector<std::string>> methods_from(const std::string& list,
                                              const ThinkingOptions& thinking,
                                              const std::string& danger) {
  std::vector<std::string> names;
  std::vector<std::string> known;
  for (const eval::MethodInfo& info : eval::methods()) {
    known.emplace_back(info.name);
    if (list.empty() && missing_for(info, thinking, danger) == nullptr) {
      names.emplace_back(info.name);
    }
  }
  if (list.empty()) {
    return names;
  }
  for (const std::string_view word : fields_of(list, ',')) {
    const eval::MethodInfo* const info = eval::find_method(word);
    if (info == nullptr) {
      return Error{Error::Code::out_of_range, fmt::format("--methods: no method is called {}; {}",
                                                          word, suggestion(word, known))};
    }
    if (const char* const missing = missing_for(*info, thinking, danger)) {
      return Error{
          Error::Code::out_of_range,
          fmt::format("--methods: want {} with \"{}\", which {}", missing, word,
                      info->needs == eval::Needs::danger    ? "chooses by V_h"
                      : info->needs == eval::Needs::untuned ? "asks that one"
                                                            : "is SACA with all but that")};
    }
    if (std::find(names.begin(), names.end(), word) != names.end()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("--methods: want each method once, got \"{}\" twice", word)};
    }
    names.emplace_back(word);
  }
  return names;
}

std::string usual_methods(const ThinkingOptions& thinking) {
  std::string methods = "saca";
  methods += thinking.memory.empty() ? "" : ",saca_no_memory";
  methods += thinking.model == "off" ? "" : ",saca_no_model";
  methods += thinking.untuned.empty() ? "" : ",saca_untuned";
  return methods + std::string(usual_without_thinking).substr(std::string_view("saca").size());
}

Result<std::shared_ptr<const eval::Imitators>> imitators_of(const std::vector<std::string>& methods,
                                                            const std::filesystem::path& models) {
  constexpr std::array<std::pair<std::string_view, const char*>, 2> files{
      {{"imitation", "compact_rwd_ev.safetensors"}, {"imitation_drivers", "drivers.safetensors"}}};
  eval::Imitators all;
  for (const auto& [method, file] : files) {
    if (!index_of(methods, method)) {
      continue;
    }
    auto read = eval::Imitator::read(models / "imitator" / file);
    if (!read.has_value()) {
      return read.error();
    }
    all.emplace(method, std::move(read).value());
  }
  return std::make_shared<const eval::Imitators>(std::move(all));
}

}  // namespace saca::suites
