// Longer than 400 lines: an exchange with a server and its calls are one state machine; apart,
// each would show the other what is its own.
#include "saca/thinking/language_model/openai_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "saca/thinking/language_model/chat_address.h"
#include "saca/thinking/language_model/chat_stream.h"
#include "saca/thinking/language_model/curl_handle.h"
#include "saca/thinking/language_model/quote.h"
#include "saca/thinking/language_model/reply.h"

namespace saca::language_model {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t longest_refusal = 1U << 16U;  // bytes of a body that is no stream
constexpr std::size_t most_unread = 1U << 22U;  // bytes between two looks: 64 times curl's usual
constexpr Clock::Time first_pause = 50ms;
constexpr long longest_retry_after = 86'400;  // [s]; more is past any deadline
// The clock may be another than the system's, so a wait looks at it at least this often.
constexpr Clock::Time longest_look = 10ms;
// Looks after the last answer for the ends of the streams: a connection that has seen its end can
// be used again, without another handshake.
constexpr int farewell_looks = 2;
// Of a server that has never taken a connection: with the pauses between them they take 3 s. One
// that is not there must not keep a caller waiting until a deadline of minutes.
constexpr int most_refused_connections = 7;

bool is_busy(long status) {
  constexpr std::array<long, 5> busy{429, 500, 502, 503, 504};
  return std::find(busy.begin(), busy.end(), status) != busy.end();
}

bool wants_newer(long status, std::string_view refusal) {
  return status == 400 && (refusal.find("max_completion_tokens") != std::string_view::npos ||
                           refusal.find("'temperature'") != std::string_view::npos);
}

bool is_broken_connection(CURLcode code) {
  constexpr std::array<CURLcode, 5> broken{CURLE_COULDNT_CONNECT, CURLE_GOT_NOTHING,
                                           CURLE_SEND_ERROR, CURLE_RECV_ERROR, CURLE_PARTIAL_FILE};
  return std::find(broken.begin(), broken.end(), code) != broken.end();
}

// A header of its own, or part of one, must not fit into it.
std::optional<Error> refuse_settings(const OpenAiModelSettings& settings) {
  const auto visible = [](char c) { return c > ' ' && c < 0x7F; };
  if (!std::all_of(settings.key.begin(), settings.key.end(), visible)) {
    return Error{Error::Code::malformed,
                 "key of the model: want visible ASCII characters, got others"};
  }
  if (settings.model.empty()) {
    return Error{Error::Code::malformed, "want the name of a model, got none"};
  }
  return std::nullopt;
}

CurlList headers(const std::string& key) {
  CurlList list;
  const auto add = [&](const std::string& line) {
    if (curl_slist* longer = curl_slist_append(list.get(), line.c_str())) {
      (void)list.release();
      list.reset(longer);
    }
  };
  add("Content-Type: application/json");
  add("Accept: text/event-stream");
  add("Expect:");  // the body goes along at once
  if (!key.empty()) {
    add("Authorization: Bearer " + key);
  }
  return list;
}

// Called by curl, through which no exception may pass.
std::size_t keep(char* bytes, std::size_t, std::size_t size, void* arrived) noexcept {
  auto& unread = *static_cast<std::string*>(arrived);
  if (unread.size() + size > most_unread) {
    return 0;
  }
  try {
    unread.append(bytes, size);
  } catch (const std::exception&) {
    return 0;
  }
  return size;
}

}  // namespace

/// What outlives a question.
struct OpenAiModel::Connections {
  CurlMulti multi;
  CurlList headers;
  bool newer = false;  ///< the server wants questions in their newer form
};

/// One scene's request.
struct OpenAiModel::Call {
  enum class State : std::uint8_t { waiting, running, over };

  std::size_t scene = 0;
  ChatQuestion question;
  std::string body;  ///< of the question
  std::array<char, CURL_ERROR_SIZE> reason{};
  std::string arrived;  ///< not yet looked at
  std::string refusal;  ///< body of a reply that is no stream
  ChatStream stream;
  SecretFilter filter;  ///< of what the stream says
  State state = State::waiting;
  Clock::Time begin_at{0};
  Clock::Time pause = first_pause;
  std::string setback;          ///< why it was asked again, the last time
  bool connected = false;       ///< some time
  int refused_connections = 0;  ///< before it was
  bool answered = false;
  std::optional<Error> error;  ///< why there is no answer
  CurlEasy easy;

  [[nodiscard]] bool settled() const { return answered || state == State::over; }
  [[nodiscard]] long status() const {
    long code = 0;
    curl_easy_getinfo(easy.get(), CURLINFO_RESPONSE_CODE, &code);
    return code;
  }
};

/// One question: up to three calls and what has come back.
class OpenAiModel::Exchange {
 public:
  Exchange(OpenAiModel& model, const std::vector<std::string>& scenes, const AskOptions& options,
           const std::function<void(const Progress&)>& progress)
      : model_(model), progress_(progress), calls_(scenes.size()), replies_(scenes.size()) {
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      calls_[i].scene = i;
      calls_[i].question = {.model = model.settings_.model,
                            .system = model.settings_.system,
                            .scene = scenes[i],
                            .max_tokens = options.max_tokens.value_or(model.settings_.max_tokens),
                            .sampling_seed = options.sampling_seed};
    }
  }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  ~Exchange() {
    for (Call& call : calls_) {
      leave(call, Call::State::over);
    }
  }

  /// Until everything is said, the time has come, or a stop is asked for.
  void run(Clock::Time end, const std::stop_token& stop) {
    end_ = end;
    int farewells = farewell_looks;
    while (model_.clock_.now() < end_ && !stop.stop_requested()) {
      begin_what_is_due();
      int running = 0;
      curl_multi_perform(multi(), &running);
      for (Call& call : calls_) {
        hear(call);
      }
      see_ends();
      if (all(&Call::settled) && (running == 0 || --farewells < 0)) {
        return;
      }
      wait();
    }
    for (Call& call : calls_) {
      if (!call.settled()) {
        cut_short(call);
      }
    }
  }

  Result<std::vector<Reply>> result() && {
    if (std::any_of(replies_.begin(), replies_.end(),
                    [](const Reply& reply) { return !reply.answers.empty(); })) {
      return std::move(replies_);
    }
    // The server's fault says more than that time is up.
    const auto fault = std::find_if(calls_.begin(), calls_.end(), [](const Call& call) {
      return call.error && call.error->code != Error::Code::too_late;
    });
    return (fault == calls_.end() ? calls_.front() : *fault)
        .error.value_or(
            Error{Error::Code::too_late, model_.shown_ + ": want an answer, got none in time"});
  }

 private:
  [[nodiscard]] CURLM* multi() const { return model_.connections_->multi.get(); }
  [[nodiscard]] bool all(bool (Call::*property)() const) const {
    return std::all_of(calls_.begin(), calls_.end(),
                       [&](const Call& call) { return (call.*property)(); });
  }
  [[nodiscard]] std::string quoted(std::string_view text) const {
    return quote(text, model_.settings_.key);
  }

  [[nodiscard]] std::string refused(const Call& call, long status) const {
    const bool lacks_key = model_.settings_.key.empty() && (status == 401 || status == 403);
    return fmt::format(
        "want HTTP 200, got {}: {}{}", status, quoted(server_message(call.refusal)),
        lacks_key ? " (no key was given; SACA's programs take it from SACA_LLM_KEY)" : "");
  }

  void prepare(Call& call);
  void begin_what_is_due();
  void wait();
  void hear(Call& call);
  void tell(Call& call, const std::string& text);
  void see_ends();
  void see_end(Call& call, CURLcode code);
  void leave(Call& call, Call::State state);
  void fail(Call& call, Error::Code code, const std::string& what);
  void ask_again(Call& call, Clock::Time pause, const std::string& what);
  void conclude(Call& call);
  void cut_short(Call& call);
  void answer(Call& call, manoeuvre::PolicyId policy, Answer::Kind kind);

  OpenAiModel& model_;
  const std::function<void(const Progress&)>& progress_;
  Clock::Time end_{0};
  std::vector<Call> calls_;  ///< never moved: curl knows their addresses
  std::vector<Reply> replies_;
};

void OpenAiModel::Exchange::prepare(Call& call) {
  call.question.newer = model_.connections_->newer;
  call.body = json_text(call.question);
  call.easy.reset(curl_easy_init());
  CURL* easy = call.easy.get();
  const OpenAiModelSettings& settings = model_.settings_;
  curl_easy_setopt(easy, CURLOPT_URL, model_.address_.c_str());
  curl_easy_setopt(easy, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(easy, CURLOPT_FOLLOWLOCATION, 0L);
  curl_easy_setopt(easy, CURLOPT_PROXY, "");  // else the environment names one
  curl_easy_setopt(easy, CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_1_1));
  curl_easy_setopt(easy, CURLOPT_HTTPHEADER, model_.connections_->headers.get());
  curl_easy_setopt(easy, CURLOPT_USERAGENT, "saca");
  curl_easy_setopt(easy, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(call.body.size()));
  curl_easy_setopt(easy, CURLOPT_POSTFIELDS, call.body.c_str());
  curl_easy_setopt(easy, CURLOPT_SSL_VERIFYPEER, 1L);
  curl_easy_setopt(easy, CURLOPT_SSL_VERIFYHOST, 2L);
  if (!settings.authorities.empty()) {
    curl_easy_setopt(easy, CURLOPT_CAINFO, settings.authorities.c_str());
    curl_easy_setopt(easy, CURLOPT_CAPATH, nullptr);
  }
  curl_easy_setopt(easy, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy, CURLOPT_QUICK_EXIT, 1L);  // else the end waits for a look-up of the host
  curl_easy_setopt(easy, CURLOPT_ERRORBUFFER, call.reason.data());
  curl_easy_setopt(easy, CURLOPT_WRITEFUNCTION, &keep);
  curl_easy_setopt(easy, CURLOPT_WRITEDATA, &call.arrived);
  curl_easy_setopt(easy, CURLOPT_PRIVATE, &call);
}

void OpenAiModel::Exchange::begin_what_is_due() {
  const Clock::Time now = model_.clock_.now();
  for (Call& call : calls_) {
    if (call.state == Call::State::waiting && call.begin_at <= now) {
      prepare(call);
      call.reason.front() = '\0';
      call.arrived.clear();
      call.refusal.clear();
      call.stream = {};
      call.filter = SecretFilter(model_.settings_.key);
      if (curl_multi_add_handle(multi(), call.easy.get()) == CURLM_OK) {
        call.state = Call::State::running;
      } else {
        fail(call, Error::Code::unreadable, "want a connection, got none: out of memory");
      }
    }
  }
}

void OpenAiModel::Exchange::wait() {
  const Clock::Time now = model_.clock_.now();
  Clock::Time next = std::min(now + longest_look, end_);
  for (const Call& call : calls_) {
    if (call.state == Call::State::waiting) {
      next = std::min(next, call.begin_at);
    }
  }
  const auto wait = std::chrono::ceil<std::chrono::milliseconds>(next - now);
  if (wait > 0ms) {
    curl_multi_poll(multi(), nullptr, 0, static_cast<int>(wait.count()), nullptr);
  }
}

void OpenAiModel::Exchange::hear(Call& call) {
  const std::string bytes = std::exchange(call.arrived, {});
  if (call.settled() || bytes.empty()) {
    return;
  }
  if (const long status = call.status(); status != 200) {
    call.refusal += bytes;
    if (call.refusal.size() > longest_refusal) {
      fail(call, Error::Code::unreadable,
           fmt::format("want HTTP 200, got {} with over 64 KiB: {}", status, quoted(call.refusal)));
    }
    return;
  }
  const Result<std::string> said = call.stream.take(bytes);
  if (!said.has_value()) {
    fail(call, said.error().code, quoted(said.error().message));
    return;
  }
  Reply& reply = replies_[call.scene];
  reply.prompt_tokens = call.stream.prompt_tokens();
  reply.reply_tokens = call.stream.reply_tokens();
  tell(call, call.filter.take(said.value()));
  if (call.stream.done()) {
    conclude(call);
  }
}

void OpenAiModel::Exchange::tell(Call& call, const std::string& text) {
  if (!text.empty()) {
    replies_[call.scene].reasoning += text;
    progress_({.prompt = call.scene, .text = text, .answer = nullptr});
  }
}

void OpenAiModel::Exchange::see_ends() {
  int left = 0;
  while (const CURLMsg* message = curl_multi_info_read(multi(), &left)) {
    if (message->msg == CURLMSG_DONE) {
      const CURLcode code = message->data.result;
      char* call = nullptr;
      curl_easy_getinfo(message->easy_handle, CURLINFO_PRIVATE, &call);
      see_end(*static_cast<Call*>(static_cast<void*>(call)), code);
    }
  }
}

void OpenAiModel::Exchange::see_end(Call& call, CURLcode code) {
  const long status = call.status();
  curl_off_t retry_after = 0;
  curl_easy_getinfo(call.easy.get(), CURLINFO_RETRY_AFTER, &retry_after);
  leave(call, Call::State::over);
  call.connected = call.connected || code != CURLE_COULDNT_CONNECT;
  if (call.answered || call.error) {
    return;
  }
  if (status != 0 && status != 200) {
    const std::string what = refused(call, status);
    if (is_busy(status)) {
      const auto wanted = std::clamp<curl_off_t>(retry_after, 0, longest_retry_after);
      ask_again(call, std::max<Clock::Time>(call.pause, std::chrono::seconds(wanted)), what);
    } else if (!call.question.newer && wants_newer(status, call.refusal)) {
      model_.connections_->newer = true;
      ask_again(call, Clock::Time(0), what);
    } else {
      fail(call, Error::Code::unreadable, what);
    }
  } else if (call.stream.finished()) {
    conclude(call);
  } else if (code != CURLE_OK) {
    const std::string reason =
        call.reason.front() != '\0' ? call.reason.data() : curl_easy_strerror(code);
    const std::string what = "want a stream of text, got " + quoted(reason);
    if (!call.connected && ++call.refused_connections >= most_refused_connections) {
      fail(call, Error::Code::unreadable,
           fmt::format("{} ({} times)", what, call.refused_connections));
    } else if (is_broken_connection(code) && call.stream.text().empty()) {
      ask_again(call, call.pause, what);
    } else {
      fail(call, Error::Code::unreadable, what);
    }
  } else {
    fail(call, Error::Code::unreadable,
         "want a stream of text and its end, got " + quoted(call.stream.text().empty()
                                                                ? server_message(call.stream.head())
                                                                : call.stream.text()));
  }
}

void OpenAiModel::Exchange::leave(Call& call, Call::State state) {
  if (call.state == Call::State::running) {
    curl_multi_remove_handle(multi(), call.easy.get());
  }
  call.state = state;
}

void OpenAiModel::Exchange::fail(Call& call, Error::Code code, const std::string& what) {
  leave(call, Call::State::over);
  call.error = Error{code, model_.shown_ + ": " + what};
}

void OpenAiModel::Exchange::ask_again(Call& call, Clock::Time pause, const std::string& what) {
  const Clock::Time begin_at = model_.clock_.now() + pause;
  if (begin_at >= end_) {
    fail(call, Error::Code::unreadable, what + " (no time is left to ask again)");
    return;
  }
  leave(call, Call::State::waiting);
  call.begin_at = begin_at;
  call.pause *= 2;
  call.setback = what;
}

void OpenAiModel::Exchange::conclude(Call& call) {
  const std::string& text = call.stream.text();
  const bool cut = call.stream.cut();
  if (const auto policy = cut ? stated_so_far(text) : stated_policy(text)) {
    answer(call, *policy, cut ? Answer::Kind::forced : Answer::Kind::ended);
    return;
  }
  constexpr std::size_t shown = 200;  // bytes of the end, where an answer should stand
  const std::string_view end =
      std::string_view(text).substr(text.size() - std::min(shown, text.size()));
  fail(call, Error::Code::malformed,
       "want `Response to user: N` at the end of the text, got " + quoted(end));
}

void OpenAiModel::Exchange::cut_short(Call& call) {
  const std::string& text = call.stream.text();
  if (const auto policy = stated_so_far(text)) {
    answer(call, *policy, Answer::Kind::forced);
  } else if (const long status = call.status();
             call.state == Call::State::running && status >= 300) {
    fail(call, Error::Code::unreadable, refused(call, status));
  } else {
    const std::string before = call.setback.empty() ? "" : "; before that: " + call.setback;
    fail(call, Error::Code::too_late,
         fmt::format("want an answer before the deadline, got {} bytes of text{}", text.size(),
                     before));
  }
}

void OpenAiModel::Exchange::answer(Call& call, manoeuvre::PolicyId policy, Answer::Kind kind) {
  call.answered = true;
  tell(call, call.filter.rest());
  Answer answer{.time = model_.clock_.now(), .kind = kind};
  answer.probability[manoeuvre::index(policy)] = 1.0;
  Reply& reply = replies_[call.scene];
  reply.answers.push_back(answer);
  progress_({.prompt = call.scene, .text = {}, .answer = &reply.answers.back()});
}

OpenAiModel::OpenAiModel(OpenAiModelSettings settings, Clock& clock)
    : settings_(std::move(settings)), clock_(clock), connections_(std::make_unique<Connections>()) {
  expects(settings_.max_tokens > 0 && settings_.margin > 0.0, "max_tokens > 0 and margin > 0");
  static const CURLcode begun =
      curl_global_init(CURL_GLOBAL_DEFAULT);  // never ended: others may use it
  const Result<std::string> address = chat_address(settings_.url, !settings_.key.empty());
  refusal_ = refuse_settings(settings_);
  if (!address.has_value()) {
    refusal_ = Error{address.error().code, quote(address.error().message, settings_.key)};
  }
  if (refusal_) {
    return;
  }
  address_ = address.value();
  shown_ = quote(address_, settings_.key);
  connections_->multi.reset(begun == CURLE_OK ? curl_multi_init() : nullptr);
  connections_->headers = headers(settings_.key);
  if (!connections_->multi || !connections_->headers) {
    refusal_ = Error{Error::Code::unreadable, shown_ + ": want connections, got no memory"};
  }
}

OpenAiModel::~OpenAiModel() = default;

Result<std::vector<Reply>> OpenAiModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const Progress&)>& progress, const AskOptions& options) {
  if (refusal_) {
    return *refusal_;
  }
  const Clock::Time end = deadline - from_seconds(settings_.margin);
  if (clock_.now() >= end) {
    return Error{Error::Code::too_late, shown_ + ": no time is left to ask"};
  }
  Exchange exchange(*this, scenes, options, progress);
  exchange.run(end, options.stop);
  return std::move(exchange).result();
}

std::string OpenAiModel::description() const {
  return quote(settings_.model + " at " + shown_address(settings_.url), settings_.key);
}

}  // namespace saca::language_model
