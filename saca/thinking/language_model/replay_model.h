#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {

/// A reply that was given once, with the prompt that it answers.
struct RecordedReply {
  std::string prompt;
  int sampling_seed = 0;  ///< with which it was asked (AskOptions)
  Reply reply;            ///< answer times count from the question
};

/// Replies by `prompt_key` of their prompt, and what gave them.
struct RecordedReplies {
  std::string model;  ///< its description
  std::map<std::string, RecordedReply> replies;
};

/// Short name of a prompt in a file: 64-bit FNV-1a in hexadecimal, where tokens were drawn of the
/// prompt, a line end, and the seed in decimal. Two prompts with one key would be told apart by
/// their text, which is kept with it.
[[nodiscard]] std::string prompt_key(std::string_view prompt, int sampling_seed = 0);

/// The file of docs/model-protocol.md, schema `saca.replies/1`.
[[nodiscard]] std::string json_text(const RecordedReplies& replies);
/// @return  malformed, naming source, key, what was wanted and what came
[[nodiscard]] Result<RecordedReplies> parse_replies(std::string_view text, std::string_view source);

/// Passes questions on to a model and keeps what it says. Prompts that it did not answer are not
/// kept; of a prompt asked twice with one seed the later reply is.
class RecordingModel final : public LanguageModel {
 public:
  /// @param model  outlives this
  RecordingModel(LanguageModel& model, Clock& clock) : model_(model), clock_(clock) {}

  [[nodiscard]] std::string description() const override { return model_.description(); }

  [[nodiscard]] RecordedReplies recorded() const;
  /// @return  nullopt when the whole file is there
  [[nodiscard]] std::optional<Error> write(const std::filesystem::path& path) const;

 private:
  [[nodiscard]] Result<std::vector<Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const Progress&)>& progress, const AskOptions& options) override;

  LanguageModel& model_;
  Clock& clock_;
  std::map<std::string, RecordedReply> replies_;
};

enum class ReplayPace : std::uint8_t {
  as_recorded,  ///< each answer is waited for, on the clock
  at_once,      ///< everything is there immediately, dated as recorded
};

/// Says what was said before. A prompt that it does not know has no answer: too_late when the first
/// recorded answer comes after the deadline, unreadable when no prompt is known.
class ReplayModel final : public LanguageModel {
 public:
  ReplayModel(RecordedReplies replies, ReplayPace pace, Clock& clock)
      : replies_(std::move(replies)),
        pace_(pace),
        clock_(clock),
        description_("replay of " + replies_.model + " (" + prompt_key(json_text(replies_)) + ")") {
  }

  [[nodiscard]] std::string description() const override { return description_; }

 private:
  struct Recalled;
  /// What answers these scenes before the deadline.
  /// @param begin  when they were asked about: recorded times count from there
  [[nodiscard]] Recalled recall(const std::vector<std::string>& scenes, Clock::Time begin,
                                Clock::Time deadline, int sampling_seed) const;
  [[nodiscard]] Result<std::vector<Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const Progress&)>& progress, const AskOptions& options) override;

  RecordedReplies replies_;
  ReplayPace pace_;
  Clock& clock_;
  std::string description_;  ///< with a digest of the replies
};

}  // namespace saca::language_model
