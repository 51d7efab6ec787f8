#include "tests/support/postgres_server.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cstdlib>
#include <stdexcept>

namespace saca::test {
namespace {

constexpr int not_installed = 77;

int run_script(const std::string& arguments) {
  const int status = std::system(("tests/support/postgres_server.sh " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void must_run(const std::string& arguments) {
  if (run_script(arguments) != 0) {
    throw std::runtime_error("postgres_server.sh " + arguments + " failed");
  }
}

/// Where a server of another user can go, too. What is in it is only readable for that user.
std::filesystem::path new_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "saca_pg_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr || ::chmod(name.c_str(), 0755) != 0) {
    throw std::runtime_error(name + ": cannot be made");
  }
  return name;
}

}  // namespace

std::unique_ptr<PostgresServer> PostgresServer::start() {
  const std::filesystem::path folder = new_folder();
  const int status = run_script("start " + folder.string());
  if (status == not_installed) {
    return nullptr;
  }
  if (status != 0) {
    throw std::runtime_error("no PostgreSQL server starts in " + folder.string());
  }
  return std::unique_ptr<PostgresServer>(new PostgresServer(folder));
}

std::unique_ptr<PostgresServer> PostgresServer::replica_of(const PostgresServer& primary) {
  const std::filesystem::path folder = new_folder();
  must_run("replica " + folder.string() + " " + primary.folder_.string());
  return std::unique_ptr<PostgresServer>(new PostgresServer(folder));
}

PostgresServer::~PostgresServer() {
  (void)run_script("kill " + folder_.string() + " 2>/dev/null");
  std::error_code left_over;
  std::filesystem::remove_all(folder_, left_over);
}

std::string PostgresServer::url() const {
  return "postgresql://saca@/postgres?host=" + folder_.string();
}

void PostgresServer::kill() const {
  must_run("kill " + folder_.string());
}

void PostgresServer::start_again() const {
  must_run("start " + folder_.string());
}

}  // namespace saca::test
