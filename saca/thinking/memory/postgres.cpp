#include "saca/thinking/memory/postgres.h"

#include <fmt/core.h>
#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <utility>

#include "saca/base/core/printable.h"

namespace saca::memory {
namespace {

// Numbers of PostgreSQL's own types, the same in every server (pg_type.dat).
constexpr Oid int8_type = 20;
constexpr Oid int4_type = 23;
constexpr Oid float8_type = 701;

struct FreeOptions {
  void operator()(PQconninfoOption* options) const { PQconninfoFree(options); }
};

/// Waits until the connection can be read or written.
/// @return  false: not in time
bool ready(int socket, short events, PostgresConnection::Time until) {
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until - std::chrono::steady_clock::now());
    pollfd one{.fd = socket, .events = events, .revents = 0};
    const int found = ::poll(&one, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (found > 0) {
      return true;
    }
    if (found == 0 && left.count() <= 0) {
      return false;
    }
  }
}

/// The server is shut down or starts, or the connection has a fault: the classes 57P and 08 of
/// PostgreSQL's table of error codes.
bool ends_connection(std::string_view state) {
  return state.starts_with("57P") || state.starts_with("08");
}

template <class Number>
Cell number_in(std::string_view text) {
  Number number{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && end == text.data() + text.size() ? Cell(number)
                                                                    : Cell(std::string(text));
}

}  // namespace

bool is_postgres_url(std::string_view place) noexcept {
  return place.starts_with("postgresql://") || place.starts_with("postgres://");
}

std::string printable_url(const std::string& url) {
  const std::unique_ptr<PQconninfoOption, FreeOptions> options(
      PQconninfoParse(url.c_str(), nullptr));
  if (!options) {
    return "postgresql://";
  }
  std::map<std::string_view, std::string> given;
  for (const PQconninfoOption* option = options.get(); option->keyword != nullptr; ++option) {
    if (option->val != nullptr) {
      given[option->keyword] = one_line(option->val);
    }
  }
  const auto after = [&given](const char* mark, const char* key) {
    return given.contains(key) ? mark + given[key] : std::string();
  };
  return "postgresql://" + (given.contains("user") ? given["user"] + "@" : "") + given["host"] +
         after(":", "port") + after("/", "dbname");
}

void Rows::Clear::operator()(pg_result* result) const {
  PQclear(result);
}

void PostgresConnection::Finish::operator()(pg_conn* connection) const {
  PQfinish(connection);
}

int Rows::size() const {
  return PQntuples(result_.get());
}

Cell Rows::cell(int row, int column) const {
  if (PQgetisnull(result_.get(), row, column) != 0) {
    return {};
  }
  const std::string_view text(PQgetvalue(result_.get(), row, column),
                              static_cast<std::size_t>(PQgetlength(result_.get(), row, column)));
  switch (PQftype(result_.get(), column)) {
    case int4_type:
    case int8_type:
      return number_in<std::int64_t>(text);
    case float8_type:
      return number_in<double>(text);
    default:
      return std::string(text);
  }
}

std::int64_t Rows::integer(int row, int column) const {
  const Cell found = cell(row, column);
  const auto* const number = std::get_if<std::int64_t>(&found);
  return number == nullptr ? 0 : *number;
}

std::int64_t Rows::changed() const {
  const Cell number = number_in<std::int64_t>(PQcmdTuples(result_.get()));
  const auto* const found = std::get_if<std::int64_t>(&number);
  return found == nullptr ? 0 : *found;
}

bool PostgresConnection::is_open() const {
  return connection_ && PQstatus(connection_.get()) == CONNECTION_OK;
}

std::optional<PostgresFailure> PostgresConnection::lost() {
  const std::string why =
      connection_ ? one_line(PQerrorMessage(connection_.get())) : "there is no connection";
  connection_.reset();
  return PostgresFailure{.kind = PostgresFailure::Kind::lost, .state = "", .why = why};
}

std::optional<PostgresFailure> PostgresConnection::late() {
  connection_.reset();
  return PostgresFailure{
      .kind = PostgresFailure::Kind::late, .state = "", .why = "it did not answer in time"};
}

std::optional<PostgresFailure> PostgresConnection::open(Time until) {
  // What the URL says comes after these, and before the defaults of the environment.
  constexpr std::array keywords{"fallback_application_name", "client_encoding", "dbname",
                                static_cast<const char*>(nullptr)};
  const std::array values{"saca", "UTF8", url_.c_str(), static_cast<const char*>(nullptr)};
  connection_.reset(PQconnectStartParams(keywords.data(), values.data(), 1));
  if (!connection_ || PQstatus(connection_.get()) == CONNECTION_BAD) {
    return lost();
  }
  // What the server says besides, such as that a table is there already, is no news for anybody.
  PQsetNoticeProcessor(
      connection_.get(), [](void* /*nothing*/, const char* /*text*/) {}, nullptr);
  PostgresPollingStatusType state = PGRES_POLLING_WRITING;
  while (state != PGRES_POLLING_OK) {
    const short events = state == PGRES_POLLING_READING ? POLLIN : POLLOUT;
    if (!ready(PQsocket(connection_.get()), events, until)) {
      return late();
    }
    state = PQconnectPoll(connection_.get());
    if (state == PGRES_POLLING_FAILED) {
      return lost();
    }
  }
  PQsetnonblocking(connection_.get(), 1);
  return std::nullopt;
}

std::optional<PostgresFailure> PostgresConnection::send(const std::string& sql,
                                                        std::span<const Cell> values, Time until) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const Cell& value : values) {
    texts.push_back(text_of(value));
  }
  std::vector<const char*> parameters;
  parameters.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    parameters.push_back(std::holds_alternative<std::monostate>(values[i]) ? nullptr
                                                                           : texts[i].c_str());
  }
  if (PQsendQueryParams(connection_.get(), sql.c_str(), static_cast<int>(parameters.size()),
                        nullptr, parameters.data(), nullptr, nullptr, 0) == 0) {
    return lost();
  }
  while (true) {
    const int left = PQflush(connection_.get());
    if (left == 0) {
      return std::nullopt;
    }
    if (left < 0) {
      return lost();
    }
    if (!ready(PQsocket(connection_.get()), POLLIN | POLLOUT, until)) {
      return late();
    }
    if (PQconsumeInput(connection_.get()) == 0) {
      return lost();
    }
  }
}

std::optional<PostgresFailure> PostgresConnection::run(const std::string& sql,
                                                       std::span<const Cell> values, Time until,
                                                       Rows& rows) {
  if (!is_open()) {
    return lost();
  }
  if (auto failure = send(sql, values, until)) {
    return failure;
  }
  Rows answer;
  std::optional<PostgresFailure> refused;
  while (true) {
    while (PQisBusy(connection_.get()) != 0) {
      if (!ready(PQsocket(connection_.get()), POLLIN, until)) {
        return late();
      }
      if (PQconsumeInput(connection_.get()) == 0) {
        return lost();
      }
    }
    PGresult* const result = PQgetResult(connection_.get());
    if (result == nullptr) {
      break;
    }
    const ExecStatusType status = PQresultStatus(result);
    if (status == PGRES_TUPLES_OK || status == PGRES_COMMAND_OK) {
      answer = Rows(result);
      continue;
    }
    const char* const state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
    const char* const message = PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY);
    refused = PostgresFailure{.kind = PostgresFailure::Kind::refused,
                              .state = state == nullptr ? "" : state,
                              .why = one_line(message == nullptr ? "no reason given" : message)};
    PQclear(result);
  }
  if (!refused) {
    rows = std::move(answer);
    return std::nullopt;
  }
  if (PQstatus(connection_.get()) != CONNECTION_OK || ends_connection(refused->state)) {
    connection_.reset();
    refused->kind = PostgresFailure::Kind::lost;
  }
  return refused;
}

}  // namespace saca::memory
