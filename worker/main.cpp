// fjord-worker: reads flags, runs the Worker until it ends or SIGTERM or SIGINT comes.
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <string>

#include "engine/base/fpenv.h"
#include "engine/base/printable.h"
#include "proto/fjord/address.h"
#include "proto/fjord/protocol.h"
#include "worker/identity.h"
#include "worker/worker.h"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kLookMs = 200;

}  // namespace

int main(int argc, char** argv) {
  fjord::SetFloatEnvironment();
  fjord::worker::WorkerConfig config;
  std::string level = "info";
  std::vector<std::string> unit;
  CLI::App app("A worker of a Fjord farm: joins a coordinator and renders what it hands out.",
               "fjord-worker");
  app.set_version_flag("--version", std::string("fjord-worker ") + fjord::kVersion);
  app.set_config("--config", "", "Read options from FILE (lines of name=value)");
  app.add_option("--server", config.server, "HOST:PORT of the coordinator")
      ->envname("FJORD_SERVER")
      ->check([](const std::string& address) {
        const std::string defect = fjord::AddressDefect(address);
        return defect.empty() ? defect : defect + " (--server, $FJORD_SERVER or the config file)";
      })
      ->capture_default_str();
  app.add_option("--threads", config.threads, "Threads on one frame; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--tag", config.tags, "A word that says what this worker is; may be repeated");
  app.add_option("--id", config.id, "Name of this worker, the same after a restart");
  app.add_option("--cache", config.cache_dir, "Folder to keep scenes and assets in");
  app.add_flag("--stay", config.stay, "When drained, wait to be released instead of ending");
  app.add_option("--log", level, "debug, info, warn or err")->capture_default_str();
  app.add_option("--render-unit", unit,
                 "SCENE FRAME KEY: the child's side of a unit that runs alone")
      ->expected(3)
      ->group("");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "fjord-worker: error: " + std::string(error.what()) + "; see fjord-worker --help\n";
  });
  app.footer(
      "Examples:\n"
      "  fjord-worker --server 127.0.0.1:7433\n"
      "  fjord-worker --server 127.0.0.1:7433 --threads 4 --tag fast");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  spdlog::set_default_logger(spdlog::stderr_logger_mt("fjord-worker"));
  spdlog::set_level(spdlog::level::from_str(level));
  std::signal(SIGPIPE, SIG_IGN);
  if (!unit.empty()) {
    const auto channel = grpc::CreateChannel(config.server, grpc::InsecureChannelCredentials());
    const auto blobs = fjord::worker::MakeGrpcBlobs(channel, config.cache_dir, config.cache_bytes);
    const auto renderer = fjord::worker::MakeEngineRenderer(*blobs, config.threads);
    return fjord::worker::RenderForParent(
        *renderer,
        {unit[0], static_cast<uint32_t>(std::strtoul(unit[1].c_str(), nullptr, 10)), unit[2]});
  }

  // Before any thread is made, so that all of them leave these signals to this one.
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  if (config.id.empty()) config.id = fjord::worker::TakeWorkerId();
  config.program = "/proc/self/exe";
  config.session = fjord::worker::NewSessionName();
  const auto note = fjord::worker::SessionNote::Take(config.id, config.server, config.session);
  if (note != nullptr) config.ended = note->ended();
  const std::unique_ptr<fjord::worker::Worker> worker = fjord::worker::Worker::Start(config);
  const timespec look{0, kLookMs * 1'000'000L};
  while (true) {
    if (sigtimedwait(&signals, nullptr, &look) > 0) {
      spdlog::info("stopping: what this worker holds is given back");
      if (worker->Stop() && note != nullptr) note->Forget();
      return kDone;
    }
    const std::optional<fjord::Result<>> ended = worker->WaitFor(0);
    if (!ended) continue;
    if (worker->Stop() && note != nullptr) note->Forget();
    if (ended->ok()) return kDone;
    std::fprintf(stderr, "fjord-worker: %s\n", fjord::Printable(ended->error().ToString()).c_str());
    return kFailed;
  }
}
