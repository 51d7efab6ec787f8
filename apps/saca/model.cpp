#include "apps/saca/model.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <utility>

#include "apps/saca/printing.h"
#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/language_model/chat_address.h"
#include "saca/thinking/language_model/openai_model.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

constexpr Clock::Time loading_time = std::chrono::seconds(60);  // a cold disk included
constexpr std::string_view replay_prefix = "replay:";
constexpr std::string_view weights_prefix = "local:";
constexpr std::string_view llm_option = "--llm";

Result<std::unique_ptr<language_model::LanguageModel>> open_replay(const std::string& file,
                                                                   runtime::Pace pace,
                                                                   Clock& clock) {
  const auto text = read_file(file);
  if (!text.has_value()) {
    return text.error();
  }
  auto replies = language_model::parse_replies(text.value(), file);
  if (!replies.has_value()) {
    return replies.error();
  }
  const auto when = pace == runtime::Pace::real ? language_model::ReplayPace::as_recorded
                                                : language_model::ReplayPace::at_once;
  return std::unique_ptr<language_model::LanguageModel>(
      std::make_unique<language_model::ReplayModel>(std::move(replies).value(), when, clock));
}

Result<std::string> system_part(const Places& places) {
  const auto harm = prepare::read_harm(places.root / "data" / "harm.toml");
  if (!harm.has_value()) {
    return harm.error();
  }
  return language_model::system_part(harm.value());
}

/// By which the answers of these weights are softened, so that a probability is how often it is so;
/// 1 where nobody has measured it.
Result<double> temperature_of(const Places& places, const std::string& weights) {
  const auto file = places.root / "data" / "language_model.toml";
  const auto text = read_file(file);
  if (!text.has_value()) {
    return text.error();
  }
  const auto document = config::Document::parse(text.value(), file.string());
  if (!document.has_value()) {
    return document.error();
  }
  double found = 1.0;
  for (config::Table& each : document.value().root().tables("weights")) {
    const std::string name = each.text("name");
    const double temperature = each.number("temperature", {0.05, 20.0});
    if (weights.starts_with(name)) {
      found = temperature;
    }
  }
  if (const auto problem = document.value().error()) {
    return *problem;
  }
  return found;
}

/// Tells apart what may answer otherwise: by other weights, another prompt or temperature. Of the
/// weights their size and their ends count, since to read them all takes a second.
std::string fingerprint(const fs::path& weights, std::string_view system, double temperature,
                        bool flash_attention) {
  constexpr std::streamoff looked_at = 1 << 16;
  std::ifstream file(weights, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  std::string bytes(looked_at, '\0');
  Fnv hash;
  hash.add(static_cast<std::uint64_t>(size));
  for (const std::streamoff from : {std::streamoff{0}, std::max(size - looked_at, looked_at)}) {
    file.clear();
    file.seekg(from);
    file.read(bytes.data(), looked_at);
    hash.add(std::string_view(bytes).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  hash.add(system);
  hash.add(std::bit_cast<std::uint64_t>(temperature));
  hash.add(static_cast<std::uint64_t>(flash_attention));
  hash.add(static_cast<std::uint64_t>(language_model::ChildModelSettings{}.max_tokens));
  return fmt::format("{:08x}", hash.value() >> 32U);
}

/// "MODEL@URL"
Result<std::unique_ptr<language_model::LanguageModel>> open_server(const Places& places,
                                                                   const std::string& choice,
                                                                   std::size_t at, Clock& clock) {
  auto system = system_part(places);
  if (!system.has_value()) {
    return system.error();
  }
  const char* const key = std::getenv("SACA_LLM_KEY");
  language_model::OpenAiModelSettings settings{.url = choice.substr(at + 1),
                                               .model = choice.substr(0, at),
                                               .key = key == nullptr ? "" : key,
                                               .system = std::move(system).value()};
  const auto address = language_model::chat_address(settings.url, !settings.key.empty());
  if (!address.has_value()) {
    return Error{address.error().code, "--llm: " + address.error().message};
  }
  return std::unique_ptr<language_model::LanguageModel>(
      std::make_unique<language_model::OpenAiModel>(std::move(settings), clock));
}

Result<std::unique_ptr<language_model::ChildModel>> open_weights(const Places& places,
                                                                 const ModelChoice& choice,
                                                                 runtime::Pace pace, Clock& clock) {
  const std::optional<fs::path>& weights = choice.weights;
  std::error_code problem;
  if (!std::filesystem::exists(places.model_host, problem)) {
    return Error{Error::Code::unreadable,
                 places.model_host.string() +
                     ": the program that runs the language model is missing; `make model` and "
                     "`make build` make it"};
  }
  if (!weights) {
    return Error{Error::Code::unreadable,
                 (places.root / "third_party" / "models" / "choice.json").string() +
                     ": no language model is set up; `make model` gets it"};
  }
  auto system = system_part(places);
  if (!system.has_value()) {
    return system.error();
  }
  const std::string name = weights->filename().string();
  const auto temperature = temperature_of(places, name);
  if (!temperature.has_value()) {
    return temperature.error();
  }
  const std::string print =
      fingerprint(*weights, system.value(), temperature.value(), choice.flash_attention);
  std::vector<std::string> command{places.model_host.string(), "--model", weights->string(),
                                   "--temperature", fmt::format("{}", temperature.value())};
  if (choice.flash_attention) {
    command.emplace_back("--flash-attention");
  }
  if (pace == runtime::Pace::real) {
    command.emplace_back("--give-way");
  }
  auto model = std::make_unique<language_model::ChildModel>(
      language_model::ChildModelSettings{.command = std::move(command),
                                         .system = std::move(system).value(),
                                         .identity = name + " " + print},
      clock);
  if (const auto failure = model->wait_until_ready(clock.now() + loading_time)) {
    return *failure;
  }
  return model;
}

}  // namespace

Result<std::unique_ptr<language_model::ChildModel>> open_local_model(const Places& places,
                                                                     runtime::Pace pace,
                                                                     Clock& clock) {
  return open_weights(places, find_model_choice(places), pace, clock);
}

namespace {

/// nullptr: off.
Result<std::unique_ptr<language_model::LanguageModel>> open_model(const Places& places,
                                                                  const std::string& choice,
                                                                  runtime::Pace pace,
                                                                  Clock& clock) {
  if (choice == "local" || choice.starts_with(weights_prefix)) {
    ModelChoice mine = find_model_choice(places);
    if (choice != "local") {
      mine.weights = fs::path(choice.substr(weights_prefix.size()));
    }
    auto local = open_weights(places, mine, pace, clock);
    if (!local.has_value()) {
      return local.error();
    }
    return std::unique_ptr<language_model::LanguageModel>(std::move(local).value());
  }
  if (choice.starts_with(replay_prefix)) {
    return open_replay(choice.substr(replay_prefix.size()), pace, clock);
  }
  if (const std::size_t at = choice.find("@http"); at != std::string::npos && at > 0) {
    return open_server(places, choice, at, clock);
  }
  if (choice == "off") {
    return std::unique_ptr<language_model::LanguageModel>();
  }
  return Error{
      Error::Code::malformed,
      "--llm: want local, local:FILE, off, replay:FILE or MODEL@URL, got `" + choice + "`"};
}

}  // namespace

Result<ChosenModel> ChosenModel::open(const Places& places, const std::string& choice,
                                      const std::string& record, runtime::Pace pace, Clock& clock) {
  auto model = open_model(places, choice, pace, clock);
  ChosenModel chosen;
  if (model.has_value()) {
    chosen.model_ = std::move(model).value();
  } else if (choice == "local") {
    app::print(stderr, "saca: {}\nsaca: going on as with --llm off\n", model.error().message);
  } else {
    return model.error();
  }
  if (chosen.model_ && !record.empty()) {
    chosen.recording_ = std::make_unique<language_model::RecordingModel>(*chosen.model_, clock);
    chosen.record_ = record;
  }
  return chosen;
}

Result<std::unique_ptr<language_model::LanguageModel>> open_needed_model(const Places& places,
                                                                         const std::string& choice,
                                                                         runtime::Pace pace,
                                                                         Clock& clock,
                                                                         std::string_view option) {
  auto model = open_model(places, choice, pace, clock);
  if (model.has_value() && model.value() == nullptr) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want a language model to ask, got `{}`", option, choice)};
  }
  if (!model.has_value() && option != llm_option) {
    std::string message = model.error().message;
    if (message.starts_with(llm_option)) {
      message.erase(0, llm_option.size() + std::string_view(": ").size());
    }
    return Error{model.error().code, fmt::format("{}: {}", option, message)};
  }
  return model;
}

language_model::LanguageModel* ChosenModel::get() const {
  return recording_ ? recording_.get() : model_.get();
}

std::optional<Error> ChosenModel::save_replies() const {
  return recording_ ? recording_->write(record_) : std::nullopt;
}

}  // namespace saca::app
