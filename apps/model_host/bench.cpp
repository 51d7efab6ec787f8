#include "bench.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>

#include "saca/reason/child_model.h"

namespace saca::model_host {
int bench(const EngineSettings& settings, int runs, bool json, std::ostream& out) {
  SteadyClock clock;
  std::ifstream file("tools/model/prompts.txt");
  std::vector<std::string> parts(1);
  for (std::string line; std::getline(file, line);) {
    if (line == "====")
      parts.emplace_back();
    else
      parts.back() += line + '\n';
  }
  reason::ChildModel model({.command = {"/proc/self/exe", "--model", settings.model_path},
                            .system = parts[0],
                            .identity = {}},
                           clock);
  if (auto e = model.wait_until_ready(clock.now() + std::chrono::seconds(30))) {
    out << e->message << '\n';
    return 1;
  }
  out << model.description() << " load " << model.figures().load_time << " system tokens "
      << model.figures().system_tokens << '\n';
  for (int run = 0; run < runs; ++run) {
    const auto begin = clock.now();
    auto since = [&] { return std::chrono::duration<double>(clock.now() - begin).count(); };
    auto r = model.ask(
        {parts.begin() + 1, parts.end()}, begin + std::chrono::milliseconds(json ? 4200 : 4200),
        [&](const reason::Progress& p) {
          if (p.answer) {
            out << since() << " scene " << p.prompt << " kind " << int(p.answer->kind) << ":";
            for (double x : p.answer->probability) out << ' ' << x;
            out << '\n';
          }
        });
    out << "returned after " << since() << '\n';
    if (!r.has_value()) {
      out << r.error().message << '\n';
      continue;
    }
    for (auto& reply : r.value())
      out << "--- " << reply.prompt_tokens << " + " << reply.reply_tokens << "\n"
          << reply.reasoning << "\n";
  }
  return 0;
}
}  // namespace saca::model_host
