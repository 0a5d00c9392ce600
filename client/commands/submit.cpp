#include <sys/random.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/common.h"
#include "client/commands/farm_options.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/farm_client.h"
#include "client/find_job.h"
#include "client/follow_job.h"
#include "client/job_text.h"
#include "client/look_ahead.h"
#include "engine/base/digest.h"
#include "proto/fjord/protocol.h"

namespace fjord {
namespace {

struct Options {
  FarmOptions farm;
  std::string scene;
  std::string frames;
  SceneChanges changes;
  int priority = 0;
  std::string project;
  std::string request_id;
  double verify = 0;
  std::string after;
  std::string budget;
  double frame_limit = 3600;  // seconds
  bool wait = false;
};

std::string RandomId() {
  unsigned char bytes[16] = {};
  if (getrandom(bytes, sizeof bytes, 0) != sizeof bytes) return {};
  std::string id;
  for (const unsigned char byte : bytes) {
    char hex[3];
    std::snprintf(hex, sizeof hex, "%02x", byte);
    id += hex;
  }
  return id;
}

Result<v1::SubmitResponse> Submit(const Options& options, FarmClient& client, LoadedScene scene,
                                  const FrameSet& frames) {
  std::string after;
  if (!options.after.empty()) {
    Result<std::string> found = FindJob(client, options.after);
    if (!found.ok()) return found.error();
    after = std::move(found).value();
  }
  const std::string bytes = SerializeScene(scene.scene);
  const std::string digest = Sha256Of(bytes).Hex();
  std::map<std::string, std::string> blobs = std::move(scene.assets);
  blobs[digest] = bytes;
  if (const Result<size_t> put = client.PutMissing(blobs); !put.ok()) return put.error();
  v1::SubmitRequest request;
  request.set_request_id(options.request_id.empty() ? RandomId() : options.request_id);
  request.set_name(scene.scene.name());
  request.set_scene_digest(digest);
  for (const FrameSpan& span : frames.spans()) {
    v1::FrameSpan& out = *request.add_span();
    out.set_first(span.first);
    out.set_last(span.last);
    out.set_step(span.step);
  }
  request.set_frame_limit_ms(static_cast<uint32_t>(std::ceil(options.frame_limit * 1000)));
  request.set_priority(options.priority);
  request.set_project(options.project);
  request.set_verify_share(options.verify);
  request.set_after_job(after);
  request.set_protocol(kProtocol);
  return client.Submit(request);
}

int RunSubmit(const Options& options) {
  Result<FrameSet> frames = ParseFrames(options.frames);
  if (!frames.ok()) return console::Fail(frames.error());
  const Result<std::vector<Setting>> settings = SettingsOf(options.changes, options.scene);
  if (!settings.ok()) return console::Fail(settings.error());
  const Result<double> budget = ParseBudget(options.budget, kFrameBudget);
  if (!budget.ok()) return console::Fail(budget.error());
  LoadResult loaded = LoadSceneFile(options.scene, *settings);
  for (const std::string& note : loaded.notes) console::Note(note);
  if (!loaded.ok()) return console::Fail(loaded.errors);
  frames = WithinAnimation(*frames, 1, loaded.loaded.scene.output().frames(), options.scene);
  if (!frames.ok()) return console::Fail(frames.error());
  if (*budget < kNoBudget) {
    const auto animation = Animation::Make(loaded.loaded);
    if (!animation.ok()) return console::Fail(InScene(animation.error(), options.scene));
    LookAhead ahead;
    const Result<> held =
        LookAtFrames(**animation, *frames, *budget, {options.scene, *settings}, &ahead);
    if (!held.ok()) return console::Fail(held.error());
    if (!ahead.advice.empty()) console::Note(ahead.advice);
  }
  FarmClient client(options.farm.server, options.farm.Waiting());
  const Result<v1::SubmitResponse> submitted =
      Submit(options, client, std::move(loaded.loaded), *frames);
  if (!submitted.ok()) return console::Fail(submitted.error());
  const std::string& job = submitted->job_id();
  if (!options.farm.json) {
    if (const Result<> printed = console::Print(job + "\n"); !printed.ok())
      return console::Fail(printed.error());
  }
  int code = kExitDone;
  nlohmann::ordered_json json = {{"id", job}, {"existed", submitted->existed()}};
  if (options.wait) {
    const Result<v1::Job> ended = FollowJob(client, job);
    if (ended.ok()) {
      json["job"] = JobJson(*ended);
      code = ExitCodeOfJob(ended->state());
      if (!ended->error().empty()) console::Note("error: " + ended->error());
    } else {
      code = console::Fail(ended.error());
      console::Note("job " + job + " is with the farm; fjord watch " + job + " follows it");
    }
  }
  if (options.farm.json) {
    if (const Result<> printed = console::Print(json.dump(1) + "\n"); !printed.ok())
      return console::Fail(printed.error());
  }
  return code;
}

}  // namespace

void AddSubmit(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("submit", "Give a scene to the farm; prints the job id");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "Scene file")->required();
  AddFrames(command, &options->frames);
  AddSceneChanges(command, &options->changes);
  command->add_option("--priority", options->priority, "Higher goes first")
      ->check(CLI::Range(-1000, 1000));
  command->add_option("--project", options->project, "Projects share the farm fairly");
  command->add_option("--request-id", options->request_id,
                      "The same id with the same content is one job, however often it is sent");
  command->add_option("--verify", options->verify, "Share of frames rendered twice and compared")
      ->check(CLI::Range(0., 1.));
  command->add_option("--after", options->after, "Wait until this job, by id or name, is done");
  command
      ->add_option("--frame-limit", options->frame_limit,
                   "Seconds that one try of a frame may take, else it has failed; 0: any time")
      ->check(CLI::Range(0., kMostFrameSeconds))
      ->capture_default_str();
  AddBudget(command, &options->budget);
  command->add_flag("--wait", options->wait, "Follow the job to its end");
  AddPatience(command, &options->farm);
  AddFarmOptions(command, &options->farm);
  command->footer(
      "Examples:\n"
      "  fjord submit examples/taiwan-rising.scene\n"
      "  fjord submit island.scene --frames 1-24 --priority 10 --wait\n"
      "  fjord submit island.scene --frames 1-96x8,96 --size 50% --samples 1\n"
      "  fjord submit island.scene --request-id island-7 --server 127.0.0.1:7433");
  command->callback([options, run] { *run = [options] { return RunSubmit(*options); }; });
}

}  // namespace fjord
