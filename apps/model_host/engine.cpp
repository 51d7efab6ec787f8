// Longer than 400 lines: one state machine over llama.cpp: prompts that are read, replies that are
// written side by side, and a deadline over both.
#include "engine.h"

#include <llama.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "free_cores.h"
#include "recent_cost.h"
#include "reply_pace.h"
#include "saca/base/core/processor_time.h"
#include "thread_choice.h"
#include "token_choice.h"
#include "tokens.h"
#include "utf8.h"

namespace saca::model_host {
namespace {

using Tokens = std::vector<llama_token>;

// One sequence of the cache for each scene, each beginning with the evaluated system part, which
// stays there from one ask to the next. Each has its own stretch of the cache, so that a scene's
// attention does not pass over the other scenes' cells. A look at the answer is put behind the text
// and removed again.
constexpr llama_seq_id sequence(std::size_t scene) {
  return static_cast<llama_seq_id>(scene);
}

constexpr int batch_capacity = 512;
// What a step is taken to cost is this many times the dearest of the last ones, and reading answers
// this many times what as many tokens took of late: on a busy machine steps vary by about two.
constexpr double reserve_factor = 2.0;

// Of a scene's forced text at most so many tokens are evaluated in one step.
constexpr std::size_t longest_run = 64;
static_assert(longest_run * max_scenes <= batch_capacity);

constexpr int rehearsed_tokens = 2;
constexpr std::size_t telling_tokens = 64;  // a shorter prompt says nothing of a token's cost

// Asked after what was generated so far. The tokeniser splits ": 6" into ":", " " and "6", so that
// the space is forced and the digits compare at equal footing.
constexpr std::string_view answer_stem = " Response to user:";
constexpr std::string_view stated_answer = "Response to user:";

// Of all threads of this process, since it began [s].
double processor_seconds() {
  return saca::processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

// Weights that leave no memory for anything else would take the steering process down with them.
std::optional<Error> refuse_size(const std::string& path) {
  std::error_code problem;
  const auto size = std::filesystem::file_size(path, problem);
  const auto memory = static_cast<std::uintmax_t>(sysconf(_SC_PHYS_PAGES)) *
                      static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
  if (problem || size <= memory / 2) {
    return std::nullopt;
  }
  constexpr std::uintmax_t mebi = 1U << 20U;
  return Error{Error::Code::out_of_range, path + ": want weights of at most half of the memory, " +
                                              std::to_string(memory / 2 / mebi) + " MiB, got " +
                                              std::to_string(size / mebi)};
}

// Owns a llama_batch and the rule that its tokens are put in one by one.
class Batch {
 public:
  Batch() : batch_(llama_batch_init(batch_capacity, 0, 1)) {}
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  ~Batch() { llama_batch_free(batch_); }

  void clear() { batch_.n_tokens = 0; }
  [[nodiscard]] int size() const { return batch_.n_tokens; }
  [[nodiscard]] const llama_batch& get() const { return batch_; }

  /// @return  index of the token in the batch, under which its logits are found
  int add(llama_token token, llama_pos position, llama_seq_id sequence, bool with_logits) {
    const int i = batch_.n_tokens++;
    batch_.token[i] = token;
    batch_.pos[i] = position;
    batch_.n_seq_id[i] = 1;
    batch_.seq_id[i][0] = sequence;
    batch_.logits[i] = with_logits ? 1 : 0;
    return i;
  }

 private:
  llama_batch batch_;
};

// One scene while it is thought about.
struct SceneProgress {
  std::size_t scene = 0;
  llama_pos position = 0;  // of the next token in its sequence
  Tokens next;             // chosen or forced by the grammar, not yet evaluated or written
  int tokens = 0;
  std::string text;
  Utf8Splitter splitter;
  TokenChoice choice;
  bool reasoning = false;  // the next token is wanted
  bool answered = false;   // for good
  AnswerKind end = AnswerKind::forced;
};

// A scene to be thought about.
struct Task {
  Tokens prompt;
  TokenChoice choice;
};

}  // namespace

struct Engine::State {
  EngineSettings settings;
  llama_model* model = nullptr;
  llama_context* context = nullptr;
  const llama_vocab* vocab = nullptr;
  std::array<llama_token, num_answers> digits{};
  Tokens stem;         // " Response to user:" and the space
  Tokens prompt_tail;  // what stands between a scene and its reply
  llama_pos system_tokens = 0;
  Batch batch;
  // Outlive an ask: the first step of the next one is planned with them.
  RecentCost step_cost;  // of one token for each scene
  RecentCost run_cost;   // of a token where many are evaluated at once
  ReplyPace pace;
  ThreadChoice threads;
  FreeCores free_cores;
  double least_token_cost = std::numeric_limits<double>::max();  // of a prompt [s]

  // Read by the abort callback inside a step.
  Clock* clock = nullptr;
  Clock::Time stop_at{0};
  std::function<bool()> is_cancelled;

  explicit State(EngineSettings given)
      : settings(std::move(given)), threads(settings.threads, settings.gives_way) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    llama_free(context);
    llama_model_free(model);
  }

  [[nodiscard]] llama_memory_t memory() const { return llama_get_memory(context); }

  static bool must_stop(void* self) {
    const auto* state = static_cast<const State*>(self);
    return state->clock != nullptr && (state->clock->now() >= state->stop_at ||
                                       (state->is_cancelled && state->is_cancelled()));
  }

  // Evaluates the batch, or stops at `until`. False when stopped or failed.
  bool evaluate(Clock::Time until) {
    stop_at = until;
    llama_set_n_threads(context, threads.threads(), threads.threads());
    return llama_decode(context, batch.get()) == 0;
  }

  // What comes next, with all that is certain to follow it.
  void choose(SceneProgress& thought, int batch_index) const {
    add_forced(thought);
    if (thought.next.empty()) {
      thought.next.push_back(thought.choice.next(llama_get_logits_ith(context, batch_index)));
      add_forced(thought);
    }
  }

  static void add_forced(SceneProgress& thought) {
    const Tokens more = thought.choice.forced();
    thought.next.insert(thought.next.end(), more.begin(), more.end());
  }

  [[nodiscard]] std::vector<double> digit_logits(int batch_index) const {
    const float* logits = llama_get_logits_ith(context, batch_index);
    std::vector<double> result;
    for (const llama_token digit : digits) {
      result.push_back(static_cast<double>(logits[digit]));
    }
    return result;
  }

  // Evaluates `tokens` from `position` on, the last `together` of them in one step; of these the
  // logits of the first and the last are kept; none where it is 0.
  // @return  batch index of the last token; -1 when stopped
  int evaluate_run(const Tokens& tokens, llama_pos position, llama_seq_id sequence,
                   std::size_t together, Clock::Time until) {
    int last = -1;
    const std::size_t size = tokens.size();
    for (std::size_t i = 0; i < size;) {
      batch.clear();
      const std::size_t full = i + static_cast<std::size_t>(batch_capacity);
      for (const std::size_t end = full >= size ? size : std::min(full, size - together); i < end;
           ++i) {
        const bool is_kept = together > 0 && (i + together == size || i + 1 == size);
        last = batch.add(tokens[i], position++, sequence, is_kept);
      }
      if (!evaluate(until)) {
        return -1;
      }
    }
    return last;
  }

  void forget_from(std::size_t scene, llama_pos position) const {
    llama_memory_seq_rm(memory(), sequence(scene), position, -1);
  }

  // What is asked after the text so far: nothing but the space where the text asks it itself.
  [[nodiscard]] Tokens question(const SceneProgress& thought) const {
    return thought.end == AnswerKind::ended && thought.text.ends_with(stated_answer)
               ? Tokens{stem.back()}
               : stem;
  }

  // Looks at the answers of some scenes, all in one step, and forgets that it asked.
  // @return  false when the deadline came first
  bool read_answers(const std::vector<SceneProgress*>& thoughts, AnswerKind kind,
                    Clock::Time deadline, const EngineEvents& events) {
    if (thoughts.empty()) {
      return true;
    }
    const Clock::Time begin = clock->now();
    batch.clear();
    std::vector<int> at;
    for (const SceneProgress* thought : thoughts) {
      const Tokens tokens = question(*thought);
      for (std::size_t i = 0; i < tokens.size(); ++i) {
        at.push_back(batch.add(tokens[i], thought->position + static_cast<llama_pos>(i),
                               sequence(thought->scene), i + 1 == tokens.size()));
      }
      at.erase(at.end() - static_cast<std::ptrdiff_t>(tokens.size()), at.end() - 1);
    }
    const bool done = evaluate(deadline);
    for (std::size_t i = 0; done && i < thoughts.size(); ++i) {
      events.answer(thoughts[i]->scene, kind, digit_logits(at[i]));
    }
    for (const SceneProgress* thought : thoughts) {
      forget_from(thought->scene, thought->position);
    }
    if (done) {  // who is withdrawn has not been answered in next to no time
      learn_step_cost(thoughts.size(), to_seconds(clock->now() - begin));
    }
    return done;
  }

  // Until when something else than reading the answers of so many scenes may go on.
  [[nodiscard]] Clock::Time reserved(Clock::Time deadline, std::size_t scenes) const {
    const double reserve = reserve_factor * pace.cost_of(scenes * stem.size());
    return deadline - from_seconds(reserve);
  }

  // A scene whose next tokens stand in the batch.
  struct Running {
    SceneProgress* thought;
    Tokens tokens;
    int last;  // index in the batch
  };

  // How many of a scene's next tokens a step may take: up to where its reply ends or states its
  // answer. Sets `reasoning` to false when the reply has ended.
  // @param most  tokens
  [[nodiscard]] std::size_t writable(SceneProgress& thought, std::size_t most,
                                     int max_tokens) const {
    std::string text = thought.text;
    std::size_t count = 0;
    for (; count < std::min(most, thought.next.size()); ++count) {
      const llama_token token = thought.next[count];
      if (llama_vocab_is_eog(vocab, token) || text.ends_with(stated_answer) ||
          thought.tokens + static_cast<int>(count) == max_tokens) {
        break;
      }
      text += piece_of(vocab, token);
    }
    if (count == 0) {
      thought.reasoning = false;
      thought.end =
          llama_vocab_is_eog(vocab, thought.next.front()) ? AnswerKind::ended : AnswerKind::forced;
    }
    return count;
  }

  // Puts so many of a scene's next tokens into the batch.
  Running put(SceneProgress& thought, std::size_t count) {
    const auto end = thought.next.begin() + static_cast<std::ptrdiff_t>(count);
    Running running{&thought, Tokens(thought.next.begin(), end), -1};
    for (std::size_t i = 0; i < count; ++i) {
      running.last = batch.add(running.tokens[i], thought.position + static_cast<llama_pos>(i),
                               sequence(thought.scene), i + 1 == count);
    }
    return running;
  }

  // Writes what a step has evaluated, and chooses what comes next.
  void write(const Running& running, const EngineEvents& events) const {
    SceneProgress& thought = *running.thought;
    const std::string raw = text_of(vocab, running.tokens);
    const auto count = static_cast<int>(running.tokens.size());
    thought.text += raw;
    thought.tokens += count;
    thought.position += count;
    thought.next.erase(thought.next.begin(), thought.next.begin() + count);
    if (const std::string whole = thought.splitter.take(raw); !whole.empty()) {
      events.text(thought.scene, whole);
    }
    if (thought.text.ends_with(stated_answer)) {
      thought.end = AnswerKind::ended;  // the answer is read from here
      thought.reasoning = false;
    } else if (thought.next.empty()) {
      choose(thought, running.last);
    }
  }

  // Tokens of a step that takes at most so many of each scene.
  static std::size_t step_size(const std::vector<SceneProgress>& thoughts, std::size_t most) {
    std::size_t tokens = 0;
    for (const SceneProgress& thought : thoughts) {
      tokens += thought.reasoning ? std::min(most, thought.next.size()) : 0;
    }
    return tokens;
  }

  // What a step is taken to cost, by what the last ones did [s].
  [[nodiscard]] double expected_cost(std::size_t tokens, std::size_t scenes) const {
    if (tokens <= scenes) {
      return step_cost.get();
    }
    const double of_run =
        run_cost.get() > 0.0 ? run_cost.get() * static_cast<double>(tokens) : pace.cost_of(tokens);
    return std::max(step_cost.get(), of_run);
  }

  // Replies come to their conclusion where there is no time left for a further statement; not in
  // lockstep, where the world waits for them.
  void be_brief_if_short(std::vector<SceneProgress>& thoughts, double left) const {
    if (!settings.gives_way) {
      return;
    }
    std::size_t tokens = 0;
    std::size_t scenes = 0;
    for (const SceneProgress& thought : thoughts) {
      if (const auto rest = thought.choice.brief_tokens(); thought.reasoning && rest) {
        tokens += thought.next.size() + *rest;
        ++scenes;
      }
    }
    if (pace.is_short(left, tokens, scenes)) {
      for (SceneProgress& thought : thoughts) {
        thought.choice.be_brief();
        add_forced(thought);
      }
    }
  }

  // The next tokens of each scene that still reasons: all that its grammar forces, or as many as
  // there is time for.
  // @return  false when the deadline leaves time for the final answers only
  bool reason_on(std::vector<SceneProgress>& thoughts, int max_tokens, Clock::Time deadline,
                 AskFigures& figures, const EngineEvents& events) {
    const Clock::Time stop = reserved(deadline, thoughts.size());
    const Clock::Time begin = clock->now();
    be_brief_if_short(thoughts, to_seconds(stop - begin));
    const std::size_t scenes = step_size(thoughts, 1);
    const auto fits = [&](std::size_t most) {
      const double cost = expected_cost(step_size(thoughts, most), scenes);
      return begin + from_seconds(reserve_factor * cost) < stop;
    };
    std::size_t most = longest_run;
    while (most > 1 && !fits(most)) {
      most /= 2;
    }
    if (!fits(most)) {
      return false;
    }
    batch.clear();
    std::vector<Running> running;
    for (SceneProgress& thought : thoughts) {
      if (const std::size_t count = thought.reasoning ? writable(thought, most, max_tokens) : 0;
          count > 0) {
        running.push_back(put(thought, count));
      }
    }
    if (running.empty()) {
      return true;
    }
    const double computed_before = processor_seconds();
    if (!evaluate(stop)) {
      for (const Running& one : running) {  // nothing half done stays in the cache
        forget_from(one.thought->scene, one.thought->position);
      }
      return false;
    }
    note_step(running.size(), to_seconds(clock->now() - begin), computed_before, figures);
    for (const Running& one : running) {
      write(one, events);
    }
    return true;
  }

  // @param scenes  that the batch has tokens of
  // @param cost    that it took [s]
  void learn_step_cost(std::size_t scenes, double cost) {
    const auto tokens = static_cast<std::size_t>(batch.size());
    pace.add(cost, tokens);
    // A step of a few tokens for each scene tells nothing of the cost of one more.
    if (tokens >= scenes * stem.size()) {
      run_cost.add(cost / static_cast<double>(tokens));
    } else if (tokens == scenes) {
      step_cost.add(cost);
    }
  }

  // Learns from what a step of so many scenes' replies took.
  void note_step(std::size_t scenes, double cost, double computed_before, AskFigures& figures) {
    figures.reply_seconds += cost;
    learn_step_cost(scenes, cost);
    if (static_cast<std::size_t>(batch.size()) == scenes &&
        threads.note_step(scenes, cost, computing(computed_before, cost))) {
      run_cost = {};
      step_cost = {};
      step_cost.add(threads.step_alone(scenes));
      pace = {};
      pace.add(threads.step_alone(scenes), scenes);
    }
  }

  // The last answers of those whose reply came to its end in this way.
  bool conclude(std::vector<SceneProgress>& thoughts, AnswerKind kind, Clock::Time deadline,
                const EngineEvents& events) {
    std::vector<SceneProgress*> these;
    for (SceneProgress& thought : thoughts) {
      const bool ended = thought.end == AnswerKind::ended && !thought.reasoning;
      // Without any text the first answer is the last.
      const bool open = thought.tokens > 0 && !thought.answered;
      if (open && ended == (kind == AnswerKind::ended)) {
        thought.answered = true;
        these.push_back(&thought);
      }
    }
    return read_answers(these, kind, deadline, events);
  }

  // Evaluates a scene's prompt and, in the same step, reads its first answer. False when the
  // deadline came first.
  bool begin_scene(SceneProgress& thought, const Tokens& prompt, Clock::Time deadline,
                   AskFigures& figures, const EngineEvents& events) {
    look_for_others();
    const Clock::Time begin = clock->now();
    const double computed_before = processor_seconds();
    Tokens tokens = prompt;
    tokens.insert(tokens.end(), stem.begin(), stem.end());
    const int last =
        evaluate_run(tokens, system_tokens, sequence(thought.scene), 1 + stem.size(), deadline);
    const double cost = to_seconds(clock->now() - begin);
    figures.prompt_seconds += cost;
    if (last < 0) {
      return false;
    }
    learn_token_cost(cost, tokens.size());
    if (tokens.size() >= telling_tokens) {
      threads.note_prompt(cost / static_cast<double>(tokens.size()),
                          computing(computed_before, cost));
    }
    figures.prompt_tokens[thought.scene] = static_cast<int>(prompt.size());
    events.prompt_read(thought.scene, static_cast<int>(prompt.size()));
    events.answer(thought.scene, AnswerKind::first, digit_logits(last));
    thought.position = system_tokens + static_cast<llama_pos>(prompt.size());
    forget_from(thought.scene, thought.position);
    choose(thought, last - static_cast<int>(stem.size()));
    thought.reasoning = true;
    return true;
  }

  // Chooses the threads by what others left of the cores of late.
  void look_for_others() {
    if (threads.gives_way()) {
      if (const std::optional<double> cores = free_cores.since_last()) {
        threads.note_free(*cores);
      }
    }
  }

  // Of the time that the threads had, the share in which they computed.
  [[nodiscard]] double computing(double computed_before, double seconds) const {
    const double had = seconds * threads.threads();
    return had > 0.0 ? (processor_seconds() - computed_before) / had : 1.0;
  }

  void learn_token_cost(double cost, std::size_t tokens) {
    least_token_cost = std::min(least_token_cost, cost / static_cast<double>(tokens));
  }

  // What the first answer takes when everything goes as well as it ever did [s].
  [[nodiscard]] double least_cost(const Tokens& prompt) const {
    return least_token_cost * static_cast<double>(prompt.size() + stem.size());
  }

  [[nodiscard]] Result<std::vector<Task>> tasks(const std::vector<std::string>& scenes,
                                                const ReplyForm& form) const {
    std::vector<Task> result;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      // Markers of the chat form are never read from a scene: they stay plain text.
      Tokens tokens = tokens_of(vocab, scenes[i], false);
      tokens.insert(tokens.end(), prompt_tail.begin(), prompt_tail.end());
      const std::size_t room = static_cast<std::size_t>(system_tokens) + tokens.size() +
                               static_cast<std::size_t>(form.max_tokens) + stem.size();
      if (room > static_cast<std::size_t>(settings.context)) {
        return Error{Error::Code::malformed, "scene " + std::to_string(i) + ": want at most " +
                                                 std::to_string(settings.context) +
                                                 " tokens with the reply, got " +
                                                 std::to_string(room)};
      }
      auto choice = TokenChoice::make(vocab, form.grammars.empty() ? "" : form.grammars[i],
                                      form.sampling_seed);
      if (!choice.has_value()) {
        return Error{choice.error().code,
                     "scene " + std::to_string(i) + ": " + choice.error().message};
      }
      result.push_back({std::move(tokens), std::move(choice).value()});
    }
    return result;
  }

  // All of an ask: prompts and first answers, reasoning, last answers.
  AskFigures think(std::vector<Task> tasks, Clock::Time deadline, int max_tokens, Clock& its_clock,
                   const EngineEvents& events) {
    clock = &its_clock;
    is_cancelled = events.is_cancelled;
    AskFigures figures;
    figures.prompt_tokens.resize(tasks.size());
    std::vector<SceneProgress> thoughts;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      thoughts.push_back({.scene = i, .choice = std::move(tasks[i].choice)});
    }
    bool in_time = true;
    for (std::size_t i = 0; in_time && i < thoughts.size(); ++i) {
      in_time = begin_scene(thoughts[i], tasks[i].prompt, deadline, figures, events);
    }
    figures.overran = !in_time;
    const auto reasons = [](const SceneProgress& thought) { return thought.reasoning; };
    while (in_time && std::any_of(thoughts.begin(), thoughts.end(), reasons)) {
      in_time = reason_on(thoughts, max_tokens, deadline, figures, events);
      // Who has ended says so at once: the others may still take long.
      figures.overran |= !conclude(thoughts, AnswerKind::ended, deadline, events);
    }
    figures.overran |= !conclude(thoughts, AnswerKind::forced, deadline, events);
    for (const SceneProgress& thought : thoughts) {
      figures.reply_tokens.push_back(thought.tokens);
      forget_from(thought.scene, system_tokens);
    }
    clock = nullptr;
    is_cancelled = nullptr;
    return figures;
  }

  // Warms the caches up, and tells what a step of so many scenes and an answer cost, before time
  // matters.
  std::optional<Error> rehearse(std::size_t count, Clock& its_clock) {
    const EngineEvents nobody{[](std::size_t, int) {}, [](std::size_t, std::string_view) {},
                              [](std::size_t, AnswerKind, const std::vector<double>&) {}};
    auto to_rehearse =
        tasks(std::vector<std::string>(count, "Ready?"), {.max_tokens = rehearsed_tokens});
    if (!to_rehearse.has_value()) {
      return to_rehearse.error();
    }
    think(std::move(to_rehearse).value(), Clock::Time::max(), rehearsed_tokens, its_clock, nobody);
    return std::nullopt;
  }
};

Engine::Engine(std::unique_ptr<State> state) : state_(std::move(state)) {}
Engine::~Engine() = default;

Result<std::shared_ptr<Engine>> Engine::load(const EngineSettings& settings) {
  expects(settings.threads > 0 && settings.context > 0, "threads > 0 and context > 0");
  if (auto problem = refuse_size(settings.model_path)) {
    return *problem;
  }
  llama_backend_init();
  auto state = std::make_unique<State>(settings);
  llama_model_params model_params = llama_model_default_params();
  model_params.n_gpu_layers = 0;
  state->model = llama_model_load_from_file(settings.model_path.c_str(), model_params);
  if (state->model == nullptr) {
    return Error{Error::Code::unreadable, settings.model_path + ": want a GGUF model, cannot load"};
  }
  state->vocab = llama_model_get_vocab(state->model);

  llama_context_params params = llama_context_default_params();
  params.n_ctx = static_cast<std::uint32_t>(settings.context) * max_scenes;
  params.n_batch = batch_capacity;
  params.n_ubatch = batch_capacity;
  params.n_seq_max = max_scenes;
  params.n_threads = settings.threads;
  params.n_threads_batch = settings.threads;
  params.kv_unified = false;
  params.flash_attn_type =
      settings.flash_attention ? LLAMA_FLASH_ATTN_TYPE_ENABLED : LLAMA_FLASH_ATTN_TYPE_DISABLED;
  params.abort_callback = State::must_stop;
  params.abort_callback_data = state.get();
  state->context = llama_init_from_model(state->model, params);
  if (state->context == nullptr) {
    return Error{Error::Code::unreadable, settings.model_path + ": no memory for its context"};
  }

  for (std::size_t digit = 0; digit < num_answers; ++digit) {
    const Tokens tokens = tokens_of(state->vocab, std::to_string(digit), false);
    if (tokens.size() != 1) {
      return Error{Error::Code::malformed,
                   settings.model_path + ": want one token for each digit 0 to 7"};
    }
    state->digits[digit] = tokens.front();
  }
  state->stem = tokens_of(state->vocab, answer_stem, false);
  const Tokens space = tokens_of(state->vocab, " ", false);
  state->stem.insert(state->stem.end(), space.begin(), space.end());
  state->prompt_tail = tokens_of(state->vocab, "<|im_end|>\n<|im_start|>assistant\n", true);
  if (space.size() != 1 || !llama_vocab_is_control(state->vocab, state->prompt_tail.front())) {
    return Error{Error::Code::malformed,
                 settings.model_path + ": want a chat model with <|im_start|> and <|im_end|>"};
  }
  return std::shared_ptr<Engine>(new Engine(std::move(state)));
}

Result<int> Engine::set_system(std::string_view text, Clock& clock) {
  State& s = *state_;
  Tokens tokens = tokens_of(s.vocab, "<|im_start|>system\n", true);
  const Tokens body = tokens_of(s.vocab, text, false);
  const Tokens end = tokens_of(s.vocab, "<|im_end|>\n<|im_start|>user\n", true);
  tokens.insert(tokens.end(), body.begin(), body.end());
  tokens.insert(tokens.end(), end.begin(), end.end());
  if (tokens.size() >= static_cast<std::size_t>(s.settings.context)) {
    return Error{Error::Code::malformed, "system part: want fewer than " +
                                             std::to_string(s.settings.context) + " tokens, got " +
                                             std::to_string(tokens.size())};
  }
  llama_memory_clear(s.memory(), true);
  s.system_tokens = 0;
  s.clock = nullptr;  // nothing to be late for
  const Clock::Time begin = clock.now();
  const double computed_before = processor_seconds();
  if (s.evaluate_run(tokens, 0, sequence(0), 0, Clock::Time::max()) < 0) {
    return Error{Error::Code::malformed, "system part: cannot be evaluated"};
  }
  // Cold, thus dear: half of it may be enough another time.
  const double cost = to_seconds(clock.now() - begin);
  s.learn_token_cost(0.5 * cost, tokens.size());
  s.threads.note_prompt(cost / static_cast<double>(tokens.size()),
                        s.computing(computed_before, cost));
  for (std::size_t scene = 1; scene < max_scenes; ++scene) {
    llama_memory_seq_cp(s.memory(), sequence(0), sequence(scene), -1, -1);
  }
  s.system_tokens = static_cast<llama_pos>(tokens.size());
  for (std::size_t count = 1; s.threads.gives_way() && count <= max_scenes; ++count) {
    s.threads.take_one();
    if (const auto problem = s.rehearse(count, clock)) {
      return *problem;
    }
  }
  s.threads.take_all();
  if (const auto problem = s.rehearse(max_scenes, clock)) {
    return *problem;
  }
  return static_cast<int>(tokens.size());
}

Result<AskFigures> Engine::ask(const std::vector<std::string>& scenes, Clock::Time deadline,
                               const ReplyForm& form, Clock& clock, const EngineEvents& events) {
  expects(!scenes.empty() && scenes.size() <= max_scenes, "1 to 3 scenes");
  expects(form.max_tokens >= 0, "max_tokens >= 0");
  expects(form.grammars.empty() || form.grammars.size() == scenes.size(),
          "a grammar for each scene");
  State& s = *state_;
  if (s.system_tokens == 0) {
    return Error{Error::Code::malformed, "ask: want a system part first"};
  }
  auto tasks = s.tasks(scenes, form);
  if (!tasks.has_value()) {
    return tasks.error();
  }
  const double left = to_seconds(deadline - clock.now());
  if (const double least = s.least_cost(tasks.value().front().prompt); left < least) {
    return Error{Error::Code::too_late, "no time: to read a scene takes " + std::to_string(least) +
                                            " s, there are " + std::to_string(left) + " s"};
  }
  s.threads.take_all();
  // Once a step or an answer stalled for longer than an ask has, none would be tried again, and
  // every reply would be brief.
  s.step_cost.fade();
  s.run_cost.fade();
  s.pace.fade();
  return s.think(std::move(tasks).value(), deadline, form.max_tokens, clock, events);
}

std::string Engine::description() const {
  std::array<char, 256> buffer{};
  const int n = llama_model_desc(state_->model, buffer.data(), buffer.size());
  return {buffer.data(), static_cast<std::size_t>(std::clamp(n, 0, 255))};
}

std::uint64_t Engine::weight_bytes() const {
  return llama_model_size(state_->model);
}

}  // namespace saca::model_host
