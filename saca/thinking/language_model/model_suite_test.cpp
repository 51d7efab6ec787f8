#include "saca/thinking/language_model/model_suite_for_test.h"

#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/openai_model.h"
#include "saca/thinking/language_model/replay_model.h"
#include "saca/thinking/language_model/rude_server_for_test.h"
#include "saca/thinking/language_model/scripted_child_for_test.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::language_model::model_suite_test {
namespace {

struct ChildStand final : ModelStand {
  LanguageModel& model() override { return model_; }

 private:
  ChildModel model_{{.command = scripted_child(R"(ready
while ask; do
  case $line in *silence*) sleep 1000;; *failure*) exit 1;; esac
  i=0
  for policy in $(printf '%s' "$line" | grep -o 'scene [0-7]' | cut -c 7); do
    text $i 'so '; says $i $policy; i=$((i + 1))
  done
  done_
done)"),
                     .system = "rules",
                     .identity = "",
                     .margin = 2.0},
                    clock};
};

struct ServerStand final : ModelStand {
  LanguageModel& model() override { return model_; }

 private:
  static void serve(Visit& visit) {
    const auto has = [&](const char* word) {
      return visit.request().find(word) != std::string::npos;
    };
    if (has("silence")) {
      visit.wait(-1);
      return;
    }
    const std::size_t at = visit.request().find("scene ");
    (void)visit.send(has("failure") ? http(400, "no")
                                    : good_reply(visit.request().at(at + 6) - '0'));
  }

  RudeServer server_{{&serve}};
  OpenAiModel model_{{.url = server_.url(), .model = "small", .system = "rules", .margin = 2.0},
                     clock};
};

struct ScriptStand final : ModelStand {
  LanguageModel& model() override { return model_; }
  static ScriptedReply reply(const std::string& scene) {
    if (scene == "silence") {
      return {};
    }
    if (scene == "failure") {
      return {.error = Error{Error::Code::unreadable, "it fails"}};
    }
    const auto policy = manoeuvre::policy_from(scene.back() - '0').value();
    return {.lines = {{.text = "so ", .answer = Answer::Kind::ended, .policy = policy}}};
  }

 private:
  ScriptedModel model_{&reply, clock};
};

struct ReplayStand final : ModelStand {
  LanguageModel& model() override { return model_; }

 private:
  static RecordedReplies recorded() {
    RecordedReplies replies{.model = "recorded", .replies = {}};
    for (const char* scene : {"scene 0", "scene 1", "scene 2", "scene 3", "scene 4", "scene 5",
                              "scene 6", "scene 7", "silence"}) {
      const bool silent = scene == std::string_view("silence");
      Answer answer{.time = std::chrono::hours(silent ? 1 : 0), .kind = Answer::Kind::ended};
      answer.probability.at(silent ? 0 : static_cast<std::size_t>(scene[6] - '0')) = 1.0;
      replies.replies[prompt_key(scene)] = {.prompt = scene,
                                            .reply = {.reasoning = "so ", .answers = {answer}}};
    }
    return replies;
  }

  ReplayModel model_{recorded(), ReplayPace::as_recorded, clock};
};

template <class Stand>
StandCase stand(const char* name) {
  return {.name = name, .make = [] { return std::make_unique<Stand>(); }};
}

INSTANTIATE_TEST_SUITE_P(Models, ModelSuite,
                         testing::Values(stand<ChildStand>("Child"), stand<ServerStand>("OpenAi"),
                                         stand<ScriptStand>("Scripted"),
                                         stand<ReplayStand>("Replay")),
                         case_name);

}  // namespace
}  // namespace saca::language_model::model_suite_test
