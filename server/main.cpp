// fjord-server: reads flags, builds the Server, waits for SIGTERM or SIGINT.
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "engine/base/fpenv.h"
#include "proto/fjord/protocol.h"
#include "server/server.h"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

}  // namespace

int main(int argc, char** argv) {
  fjord::SetFloatEnvironment();
  fjord::server::ServerConfig config;
  std::string level = "info";
  CLI::App app("The coordinator of a Fjord farm: takes jobs, hands out frames, keeps pictures.",
               "fjord-server");
  app.set_version_flag("--version", std::string("fjord-server ") + fjord::kVersion);
  app.set_config("--config", "", "Read options from FILE (lines of name=value)");
  app.add_option("--listen", config.listen, "HOST:PORT to listen on; port 0 takes a free one")
      ->capture_default_str();
  app.add_option("--data", config.data_dir, "Folder of the journal and the store")->required();
  app.add_option("--log", level, "debug, info, warn or err")->capture_default_str();
  std::string budget;
  app.add_option("--budget", budget,
                 "Triangles a frame of a job may have, by estimate, or unlimited; default 2e9")
      ->check([](const std::string& text) -> std::string {
        if (text == "unlimited" || std::strtod(text.c_str(), nullptr) > 0) return "";
        return "write a number above 0, as 5e9, or unlimited";
      });
  // Timing, for tests and unusual farms (docs/farm.md).
  fjord::server::MachineConfig& machine = config.machine;
  app.add_option("--lease-term-ms", machine.term_ms, "How long a lease lives without a renewal")
      ->check(CLI::Range(50, 3'600'000))
      ->group("");
  app.add_option("--renew-ms", machine.renew_ms, "How often workers renew")
      ->check(CLI::Range(10, 3'600'000))
      ->group("");
  app.add_option("--stall-ms", machine.stall_ms, "Progress that stands still this long ends a try")
      ->check(CLI::Range(100, 86'400'000))
      ->group("");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "fjord-server: error: " + std::string(error.what()) + "; see fjord-server --help\n";
  });
  app.footer(
      "Examples:\n"
      "  fjord-server --listen 127.0.0.1:7433 --data /var/lib/fjord\n"
      "  fjord-server --listen 127.0.0.1:0 --data farm      the port is printed");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  if (budget == "unlimited")
    config.frame_budget = fjord::kNoBudget;
  else if (!budget.empty())
    config.frame_budget = std::strtod(budget.c_str(), nullptr);
  spdlog::set_default_logger(spdlog::stderr_logger_mt("fjord-server"));
  spdlog::set_level(spdlog::level::from_str(level));

  // Before any thread is made, so that all of them leave these signals to sigwait.
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);

  std::atomic<bool> failed{false};
  config.on_failure = [&failed](const fjord::Error&) {
    failed = true;
    kill(getpid(), SIGTERM);
  };
  fjord::Result<std::unique_ptr<fjord::server::Server>> server =
      fjord::server::Server::Start(config);
  if (!server.ok()) {
    std::fprintf(stderr, "fjord-server: %s\n", server.error().ToString().c_str());
    return server.error().code == fjord::ErrorCode::kUsage ? kWrongUsage : kFailed;
  }
  std::printf("listening on %s\n", server.value()->address().c_str());
  std::fflush(stdout);
  int signal = 0;
  while (sigwait(&signals, &signal) == 0 && signal == SIGUSR1) {
    const fjord::server::JournalStats stats = server.value()->journal_stats();
    spdlog::info("journal: {} syncs, {} records, {} bytes, largest batch {}, {} us in commits",
                 stats.batches, stats.records, stats.bytes, stats.largest_batch, stats.commit_us);
  }
  spdlog::info("stopping");
  server.value()->Stop();
  return failed ? kFailed : kDone;
}
