#include "saca/lab/paper_comparison/table_request.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace saca::paper_comparison {

namespace fs = std::filesystem;
using eval::PaperTable;

std::string number_of(const PaperTable& table) {
  return std::string(table.name.substr(std::string_view("table_").size()));
}

bool is_wanted(const PaperTable& table, const TableRequest& request) {
  return request.only.empty() || std::find(request.only.begin(), request.only.end(),
                                           number_of(table)) != request.only.end();
}

std::vector<std::string> compared_methods(const suites::ThinkingOptions& thinking) {
  const bool has_model = thinking.model != "off";
  std::vector<std::string> methods{"saca"};
  const auto add = [&](bool is_there, std::initializer_list<const char*> names) {
    methods.insert(methods.end(), is_there ? names.begin() : names.end(), names.end());
  };
  add(!thinking.memory.empty(), {"saca_no_memory"});
  add(has_model, {"saca_no_model"});
  add(!thinking.untuned.empty(), {"saca_untuned"});
  add(true, {"saca_unaware", "saca_paper"});
  add(!thinking.untuned.empty(), {"saca_paper_untuned"});
  add(has_model, {"saca_paper_unaware"});
  add(true, {"imitation", "aeb", "rss", "beliefs_rolled_out", "oracle"});
  return methods;
}

int num_few(std::size_t num_conditions) {
  return few_draws * static_cast<int>(num_conditions);
}

suites::SuiteRequest suite_of(const PaperTable& table, std::size_t num_conditions,
                              const TableRequest& request) {
  const auto num = static_cast<int>(num_conditions);
  const int draws = std::max(few_draws, (request.count + num - 1) / num);
  suites::SuiteRequest suite;
  suite.name = table.name;
  suite.count = draws * num;
  suite.thinking = request.thinking;
  suite.seed = request.seed;
  suite.threads = request.threads;
  suite.output = (fs::path(request.output) / fmt::format("{}.h5", table.name)).string();
  return suite;
}

std::string command_text(const TableRequest& request) {
  return fmt::format(
      "saca tables --count {} --seed {}{}{}{}", request.count, request.seed,
      suites::thinking_text(request.thinking),
      request.methods.empty() ? "" : " --methods " + request.methods,
      request.only.empty() ? "" : fmt::format(" --table {}", fmt::join(request.only, ",")));
}

}  // namespace saca::paper_comparison
