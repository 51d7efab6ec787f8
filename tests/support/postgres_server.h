#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace saca::test {

/// A PostgreSQL server in a folder of its own (postgres_server.sh), which ends with this object.
class PostgresServer {
 public:
  /// @return  nullptr: PostgreSQL is not installed
  /// @throws std::runtime_error  if it is, and does not start
  [[nodiscard]] static std::unique_ptr<PostgresServer> start();
  /// One that follows another, and may only be read.
  [[nodiscard]] static std::unique_ptr<PostgresServer> replica_of(const PostgresServer& primary);

  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;
  ~PostgresServer();

  /// Of a database that is there.
  [[nodiscard]] std::string url() const;

  /// As if the power were lost.
  void kill() const;
  /// Again, after `kill`.
  void start_again() const;

 private:
  explicit PostgresServer(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
};

}  // namespace saca::test
