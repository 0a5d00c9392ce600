#include "server/server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <mutex>
#include <set>
#include <vector>

#include "proto/fjord/address.h"
#include "proto/fjord/protocol.h"
#include "server/blobs_service.h"
#include "server/data_dir.h"
#include "server/disk_watch.h"
#include "server/engine_planner.h"
#include "server/jobs_service.h"
#include "server/leases_service.h"

namespace fjord::server {
namespace {

constexpr size_t kMaxDiskWork = 4'000;
constexpr std::chrono::milliseconds kLastWords{200};
constexpr int kKeepaliveMs = 20'000;
constexpr int kShortestPingMs = 5'000;

// Known by their files' sizes alone: what they hold is looked at when it is asked for.
std::vector<Digest> LostPictures(const Snapshot& snapshot, BlobStore& blobs) {
  std::set<Digest> lost;
  for (const ResultRow& row : snapshot.results) {
    const std::optional<uint64_t> size = blobs.SizeOf(row.blob);
    const bool whole = size && *size > 0 && (row.bytes == 0 || row.bytes == *size);
    if (!whole && !blobs.Check(row.blob)) lost.insert(row.blob);
  }
  return {lost.begin(), lost.end()};
}

class ServerImpl : public Server {
 public:
  explicit ServerImpl(ServerConfig config) : config_(std::move(config)) {}
  ~ServerImpl() override { Stop(); }

  Result<> Start();
  int port() const override { return port_; }
  std::string address() const override {
    return config_.listen.substr(0, config_.listen.rfind(':')) + ":" + std::to_string(port_);
  }
  uint64_t epoch() const override { return epoch_; }
  JournalStats journal_stats() const override { return journal_->stats(); }
  void Stop() override;

 private:
  Result<> Bind();
  // Who hears of a full disk; null: nobody.
  void TellTroubleTo(Coordinator* coordinator) {
    const std::lock_guard lock(told_mutex_);
    told_ = coordinator;
  }

  ServerConfig config_;
  SystemClock clock_;
  int port_ = 0;
  uint64_t epoch_ = 0;
  std::mutex stop_mutex_;
  bool stopped_ = false;
  std::mutex told_mutex_;
  Coordinator* told_ = nullptr;  // guarded by told_mutex_

  // In the order of their making; each needs those above it.
  std::unique_ptr<DataDir> data_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<BlobStore> blobs_;
  std::unique_ptr<DiskWatch> disk_;
  std::unique_ptr<EnginePlanner> engine_planner_;
  std::unique_ptr<IoPool> pool_;
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<JobsService> jobs_;
  std::unique_ptr<LeasesService> leases_;
  std::unique_ptr<BlobsService> blobs_service_;
  std::unique_ptr<grpc::Server> grpc_;
};

Result<> ServerImpl::Start() {
  const Result<bool> loopback = IsLoopback(config_.listen);
  if (!loopback.ok()) return loopback.error();
  if (!*loopback) {
    return MakeError(
        ErrorCode::kUsage,
        "--listen " + config_.listen +
            ": only this machine's own addresses can be used: TLS and tokens, which any "
            "other address needs, are not there yet. Listen on 127.0.0.1");
  }
  Result<std::unique_ptr<DataDir>> data = DataDir::Open(config_.data_dir);
  if (!data.ok()) return data.error();
  data_ = std::move(*data);
  Result<std::unique_ptr<BlobStore>> blobs = BlobStore::Open(config_.data_dir, kMaxBlob);
  if (!blobs.ok()) return blobs.error();
  blobs_ = std::move(*blobs);
  Result<std::unique_ptr<Journal>> journal =
      OpenSqliteJournal(config_.data_dir, "process " + std::to_string(getpid()));
  if (!journal.ok()) return journal.error();
  journal_ = std::move(*journal);
  Result<Snapshot> snapshot = journal_->Load();
  if (!snapshot.ok()) return snapshot.error();
  epoch_ = snapshot->epoch;
  if (config_.planner == nullptr) {
    engine_planner_ = std::make_unique<EnginePlanner>(*blobs_, config_.frame_budget);
    config_.planner = engine_planner_.get();
  }
  spdlog::info("epoch {}: {} jobs, {} pictures known, {} blobs", epoch_, snapshot->jobs.size(),
               snapshot->results.size(), blobs_->count());
  pool_ = std::make_unique<IoPool>(config_.io_threads, kMaxDiskWork);
  disk_ = std::make_unique<DiskWatch>(config_.data_dir, [this](const std::string& trouble) {
    const std::lock_guard lock(told_mutex_);
    if (told_ != nullptr) {
      told_->PostInner([trouble](Machine& machine, Now) { machine.Trouble(trouble); });
    }
  });
  blobs_->OnFull([this](uint64_t bytes) { disk_->Full(bytes); });
  const std::vector<Digest> lost = LostPictures(*snapshot, *blobs_);
  coordinator_ = std::make_unique<Coordinator>(
      config_.machine, std::move(*snapshot), *journal_, *config_.planner, clock_,
      Coordinator::Store{[this](const Digest& blob) { return blobs_->Check(blob); },
                         [this] { disk_->Full(0); }},
      [this](const Error& error) {
        spdlog::critical("{}", error.ToString());
        if (config_.on_failure) config_.on_failure(error);
      });
  TellTroubleTo(coordinator_.get());
  blobs_->OnLost([coordinator = coordinator_.get()](const Digest& blob) {
    coordinator->PostInner([blob](Machine& machine, Now now) { machine.BlobsLost({blob}, now); });
  });
  if (!lost.empty()) {
    spdlog::warn("{} stored pictures are gone or cut off: their frames are made again",
                 lost.size());
    coordinator_->PostInner([lost](Machine& machine, Now now) { machine.BlobsLost(lost, now); });
  }
  return Bind();
}

Result<> ServerImpl::Bind() {
  jobs_ = std::make_unique<JobsService>(*coordinator_, *blobs_, *pool_);
  leases_ = std::make_unique<LeasesService>(*coordinator_, *blobs_);
  blobs_service_ = std::make_unique<BlobsService>(*blobs_, *pool_);
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  builder.SetMaxReceiveMessageSize(kMaxMessage);
  // Two coordinators on one port would each get half of the calls.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveMs);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
                             kShortestPingMs);
  builder.AddListeningPort(config_.listen, grpc::InsecureServerCredentials(), &port_);
  builder.RegisterService(jobs_.get());
  builder.RegisterService(leases_.get());
  builder.RegisterService(blobs_service_.get());
  grpc_ = builder.BuildAndStart();
  if (grpc_ == nullptr || port_ == 0) {
    return MakeError(ErrorCode::kUnavailable,
                     "cannot listen on " + config_.listen +
                         ": is another program using the port? Port 0 takes a free one");
  }
  return {};
}

void ServerImpl::Stop() {
  const std::lock_guard lock(stop_mutex_);
  if (std::exchange(stopped_, true)) return;
  if (coordinator_ != nullptr) coordinator_->Close();
  if (grpc_ != nullptr) {
    // The calls are ended; what is left are idle connections whose clients do not look.
    grpc_->Shutdown(std::chrono::system_clock::now() + kLastWords);
    grpc_->Wait();
    grpc_.reset();
  }
  TellTroubleTo(nullptr);
  coordinator_.reset();
  pool_.reset();
  if (journal_ != nullptr) {
    const JournalStats stats = journal_->stats();
    spdlog::info("journal: {} syncs, {} records, {} bytes, largest batch {}", stats.batches,
                 stats.records, stats.bytes, stats.largest_batch);
  }
}

}  // namespace

Result<bool> IsLoopback(const std::string& address) {
  if (const std::string defect = AddressDefect(address, PortZero::kTakesAFreeOne);
      !defect.empty()) {
    return MakeError(ErrorCode::kUsage, "--listen " + defect);
  }
  const std::string host = address.substr(0, address.rfind(':'));
  if (host == "localhost" || host == "[::1]") return true;
  // 127.0.0.0/8, written out: a name that only begins so is not one.
  int dots = 0;
  for (const char c : host) {
    if (c == '.') {
      ++dots;
    } else if (c < '0' || c > '9') {
      return false;
    }
  }
  return dots == 3 && host.rfind("127.", 0) == 0;
}

Result<std::unique_ptr<Server>> Server::Start(ServerConfig config) {
  auto server = std::make_unique<ServerImpl>(std::move(config));
  if (const Result<> started = server->Start(); !started.ok()) return started.error();
  return std::unique_ptr<Server>(std::move(server));
}

}  // namespace fjord::server
