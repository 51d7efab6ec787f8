#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/memory/scene_json.h"
#include "saca/memory/store.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct MemoryOptions {
  std::string file = "runs/memory.sqlite";
  std::int64_t id = 0;
  bool as_json = false;
};

json case_json(const memory::Case& one) {
  return {{"id", one.id},
          {"source", one.source},
          {"policy", manoeuvre::index(one.plan.policy)},
          {"best", manoeuvre::index(one.best)},
          {"harm", one.harm},
          {"best_harm", one.best_harm},
          {"collision_loss", one.collision_loss},
          {"review", one.review}};
}

/// An existing file only: to look must not make one.
Result<memory::Store> open_existing(const std::string& file) {
  std::error_code problem;
  if (!std::filesystem::exists(file, problem)) {
    return Error{Error::Code::unreadable, file + ": there is no such memory bank"};
  }
  return memory::Store::open(file);
}

int list_cases(const MemoryOptions& options) {
  auto store = open_existing(options.file);
  if (!store.has_value()) {
    complain(store.error().message);
    return bad_input;
  }
  memory::Store memory = std::move(store).value();
  const auto cases = memory.all();
  if (!cases.has_value()) {
    complain(cases.error().message);
    return bad_input;
  }
  json list = json::array();
  for (const memory::Case& one : cases.value()) {
    list.push_back(case_json(one));
    if (!options.as_json) {
      app::print("{:5}  {:24} did {} best {}  {}\n", one.id, one.source,
                 manoeuvre::index(one.plan.policy), manoeuvre::index(one.best), one.review);
    }
  }
  if (options.as_json) {
    app::print_json(list);
  } else if (cases.value().empty()) {
    app::print("{}: no cases yet\n", options.file);
  }
  return success;
}

int show_case(const MemoryOptions& options) {
  auto store = open_existing(options.file);
  if (!store.has_value()) {
    complain(store.error().message);
    return bad_input;
  }
  memory::Store memory = std::move(store).value();
  const auto found = memory.find(options.id);
  if (!found.has_value()) {
    complain(found.error().message);
    return bad_input;
  }
  if (!found.value()) {
    complain(fmt::format("{}: want an id of `saca memory list`, got {}", options.file, options.id));
    return bad_input;
  }
  json out = case_json(*found.value());
  out["scene"] = memory::to_json(found.value()->scene);
  app::print("{}\n", out.dump(1));  // a scene comes back to the last bit
  return success;
}

}  // namespace

void add_memory(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("memory", "What was learnt");
  command->require_subcommand(1);
  const auto options = std::make_shared<MemoryOptions>();
  command->add_option("--memory", options->file, "The memory bank")->capture_default_str();
  CLI::App* const list = command->add_subcommand("list", "All cases");
  list->add_flag("--json", options->as_json, "For programs");
  list->callback([options, &exit_code] { exit_code = list_cases(*options); });
  CLI::App* const show = command->add_subcommand("show", "One case, with its scene, as JSON");
  show->add_option("id", options->id)->required();
  show->callback([options, &exit_code] { exit_code = show_case(*options); });
}

}  // namespace saca::app
