#include "service.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>

#include "inbox.h"
#include "saca/thinking/language_model/protocol.h"

namespace saca::model_host {
namespace {

namespace protocol = language_model::protocol;

constexpr Clock::Time look_pause = std::chrono::milliseconds(2);  // between looks for a cancel

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0;
  std::uint64_t resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::array<double, num_answers> softmax(const std::vector<double>& logits, double temperature) {
  const double top = *std::max_element(logits.begin(), logits.end());
  std::array<double, num_answers> result{};
  double sum = 0.0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = std::exp((logits[i] - top) / temperature);
    sum += result[i];
  }
  for (double& p : result) {
    p /= sum;
  }
  return result;
}

class Service {
 public:
  Service(const EngineSettings& settings, Inbox& inbox, std::ostream& out)
      : settings_(settings), inbox_(inbox), out_(out), begin_(clock_.now()) {}

  bool load() {
    const auto loaded = Engine::load(settings_);
    if (!loaded.has_value()) {
      say(protocol::FailureMessage{std::nullopt, loaded.error().message});
      return false;
    }
    engine_ = loaded.value();
    return true;
  }

  void handle(const protocol::Start& start) {
    const auto tokens = engine_->set_system(start.system, clock_);
    if (!tokens.has_value()) {
      say(protocol::FailureMessage{std::nullopt, tokens.error().message});
      return;
    }
    say(protocol::Ready{engine_->description(), tokens.value(), to_seconds(clock_.now() - begin_)});
  }

  void handle(const protocol::Ask& ask) {
    const Clock::Time arrival = clock_.now();
    if (ask.scenes.empty() || ask.scenes.size() > max_scenes || ask.max_tokens > 4096) {
      say(protocol::FailureMessage{ask.id, "ask: want 1 to 3 scenes and at most 4096 tokens each"});
      return;
    }
    if (!ask.grammars.empty() && ask.grammars.size() != ask.scenes.size()) {
      say(protocol::FailureMessage{ask.id, "ask: want a grammar for each scene, or none"});
      return;
    }
    const EngineEvents events{
        [&](std::size_t scene, int tokens) {
          say(protocol::PromptRead{ask.id, scene, tokens});
        },
        [&](std::size_t scene, std::string_view text) {
          say(protocol::Text{ask.id, scene, std::string(text)});
        },
        [&](std::size_t scene, AnswerKind kind, const std::vector<double>& logits) {
          say(protocol::AnswerMessage{ask.id, scene, kind, softmax(logits, settings_.temperature)});
        },
        [&, next_look = arrival, cancelled = false]() mutable {
          if (const Clock::Time now = clock_.now(); !cancelled && now >= next_look) {
            next_look = now + look_pause;
            cancelled = is_cancelled(ask.id);
          }
          return cancelled;
        }};
    const double longest = 3600.0;  // [s]: nobody waits longer, and the sum below stays in range
    const auto budget = from_seconds(std::min(ask.budget, longest));
    const auto figures =
        engine_->ask(ask.scenes, arrival + budget,
                     {ask.max_tokens, ask.sampling_seed, ask.grammars}, clock_, events);
    if (!figures.has_value()) {
      say(protocol::FailureMessage{ask.id, figures.error().message,
                                   figures.error().code == Error::Code::too_late});
      return;
    }
    say(protocol::Done{ask.id, figures.value().reply_tokens, figures.value().prompt_seconds,
                       figures.value().reply_seconds, figures.value().overran});
  }

  void handle(const protocol::Cancel&) {}  // its ask is over

  void handle(const protocol::InfoRequest&) {
    say(protocol::Info{engine_->description(), settings_.model_path, engine_->weight_bytes(),
                       resident_bytes(), settings_.threads});
  }

  void say(const protocol::Event& event) { out_ << protocol::line(event) << '\n' << std::flush; }

 private:
  [[nodiscard]] bool is_cancelled(int id) {
    return inbox_.holds([id](const std::string& line) {
      const auto request = protocol::request_from(line);
      const auto* const cancel =
          request.has_value() ? std::get_if<protocol::Cancel>(&request.value()) : nullptr;
      return cancel != nullptr && cancel->id == id;
    });
  }

  EngineSettings settings_;
  Inbox& inbox_;
  std::ostream& out_;
  SteadyClock clock_;
  Clock::Time begin_;
  std::shared_ptr<Engine> engine_;
};

}  // namespace

int serve(const EngineSettings& settings, int in, std::ostream& out) {
  Inbox inbox(in);
  Service service(settings, inbox, out);
  if (!service.load()) {
    return 1;
  }
  while (const auto line = inbox.take()) {
    const auto request = protocol::request_from(*line);
    if (!request.has_value()) {
      service.say(protocol::FailureMessage{std::nullopt, request.error().message});
      continue;
    }
    std::visit([&](const auto& r) { service.handle(r); }, request.value());
  }
  return 0;
}

}  // namespace saca::model_host
