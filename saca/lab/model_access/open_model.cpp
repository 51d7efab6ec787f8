#include "saca/lab/model_access/open_model.h"

#include <fmt/core.h>

#include <chrono>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/lab/model_access/local_choice.h"
#include "saca/lab/model_access/weights.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/language_model/chat_address.h"
#include "saca/thinking/language_model/openai_model.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/replay_model.h"

namespace saca::model_access {
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

Result<std::string> system_part(const ModelSources& sources) {
  const auto harm = prepare::read_harm(sources.harm);
  if (!harm.has_value()) {
    return harm.error();
  }
  return language_model::system_part(harm.value());
}

/// "MODEL@URL"
Result<std::unique_ptr<language_model::LanguageModel>> open_server(const ModelSources& sources,
                                                                   const std::string& choice,
                                                                   std::size_t at, Clock& clock) {
  auto system = system_part(sources);
  if (!system.has_value()) {
    return system.error();
  }
  language_model::OpenAiModelSettings settings{.url = choice.substr(at + 1),
                                               .model = choice.substr(0, at),
                                               .key = sources.key,
                                               .system = std::move(system).value()};
  const auto address = language_model::chat_address(settings.url, !settings.key.empty());
  if (!address.has_value()) {
    return Error{address.error().code, "--llm: " + address.error().message};
  }
  return std::unique_ptr<language_model::LanguageModel>(
      std::make_unique<language_model::OpenAiModel>(std::move(settings), clock));
}

std::vector<std::string> child_command(const fs::path& host, const AnsweringModel& model,
                                       runtime::Pace pace) {
  std::vector<std::string> command{host.string(), "--model", model.weights.string(),
                                   "--temperature", fmt::format("{}", model.temperature)};
  if (model.flash_attention) {
    command.emplace_back("--flash-attention");
  }
  if (pace == runtime::Pace::real) {
    command.emplace_back("--give-way");
  }
  return command;
}

Result<std::unique_ptr<language_model::ChildModel>> open_weights(const ModelSources& sources,
                                                                 const LocalChoice& choice,
                                                                 runtime::Pace pace, Clock& clock) {
  const std::optional<fs::path>& weights = choice.weights;
  std::error_code problem;
  if (!fs::exists(sources.host, problem)) {
    return Error{Error::Code::unreadable,
                 sources.host.string() +
                     ": the program that runs the language model is missing; `make model` and "
                     "`make build` make it"};
  }
  if (!weights) {
    return Error{Error::Code::unreadable,
                 sources.choice.string() + ": no language model is set up; `make model` gets it"};
  }
  auto system = system_part(sources);
  if (!system.has_value()) {
    return system.error();
  }
  const std::string name = weights->filename().string();
  const auto temperature = temperature_of(sources.temperatures, name);
  if (!temperature.has_value()) {
    return temperature.error();
  }
  const AnsweringModel answering{.weights = *weights,
                                 .system = system.value(),
                                 .temperature = temperature.value(),
                                 .flash_attention = choice.flash_attention};
  auto model = std::make_unique<language_model::ChildModel>(
      language_model::ChildModelSettings{.command = child_command(sources.host, answering, pace),
                                         .system = std::move(system).value(),
                                         .identity = name + " " + fingerprint(answering)},
      clock);
  if (const auto failure = model->wait_until_ready(clock.now() + loading_time)) {
    return *failure;
  }
  return model;
}

}  // namespace

Result<std::unique_ptr<language_model::ChildModel>> open_local_model(const ModelSources& sources,
                                                                     runtime::Pace pace,
                                                                     Clock& clock) {
  return open_weights(sources, local_choice(sources.choice), pace, clock);
}

Result<std::unique_ptr<language_model::LanguageModel>> open_model(const ModelSources& sources,
                                                                  const std::string& choice,
                                                                  runtime::Pace pace,
                                                                  Clock& clock) {
  if (choice == "local" || choice.starts_with(weights_prefix)) {
    LocalChoice mine = local_choice(sources.choice);
    if (choice != "local") {
      mine.weights = fs::path(choice.substr(weights_prefix.size()));
    }
    auto local = open_weights(sources, mine, pace, clock);
    if (!local.has_value()) {
      return local.error();
    }
    return std::unique_ptr<language_model::LanguageModel>(std::move(local).value());
  }
  if (choice.starts_with(replay_prefix)) {
    return open_replay(choice.substr(replay_prefix.size()), pace, clock);
  }
  if (const std::size_t at = choice.find("@http"); at != std::string::npos && at > 0) {
    return open_server(sources, choice, at, clock);
  }
  if (choice == "off") {
    return std::unique_ptr<language_model::LanguageModel>();
  }
  return Error{
      Error::Code::malformed,
      "--llm: want local, local:FILE, off, replay:FILE or MODEL@URL, got `" + choice + "`"};
}

Result<std::unique_ptr<language_model::LanguageModel>> open_needed_model(
    const ModelSources& sources, const std::string& choice, runtime::Pace pace, Clock& clock,
    std::string_view option) {
  auto model = open_model(sources, choice, pace, clock);
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

}  // namespace saca::model_access
