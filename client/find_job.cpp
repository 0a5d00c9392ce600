#include "client/find_job.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "client/job_text.h"
#include "engine/base/printable.h"

namespace fjord {
namespace {

constexpr size_t kMostNamed = 8;

bool IsId(const std::string& text) {
  return !text.empty() && text.size() <= 18 && text[0] != '0' &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

Error Ambiguous(const std::string& name, const std::vector<const v1::Job*>& jobs) {
  std::string list;
  for (size_t i = 0; i < jobs.size() && i < kMostNamed; ++i) {
    list += (i == 0 ? "" : ", ") + jobs[i]->id() + " (" + JobStateName(jobs[i]->state()) + ")";
  }
  if (jobs.size() > kMostNamed) list += " ...";
  return Invalid(std::to_string(jobs.size()) + " jobs are named " + Printable(name) + ": " + list +
                 "; say which by its id");
}

}  // namespace

Result<std::string> FindJob(FarmClient& client, const std::string& id_or_name) {
  std::optional<Error> no_such_id;
  if (IsId(id_or_name)) {
    const Result<v1::Job> job = client.GetJob(id_or_name);
    if (job.ok()) return job->id();
    if (job.error().code != ErrorCode::kNotFound) return job.error();
    no_such_id = job.error();
  }
  const Result<std::vector<v1::Job>> jobs = client.ListJobs();
  if (!jobs.ok()) return no_such_id.value_or(jobs.error());
  std::vector<const v1::Job*> named;
  for (const v1::Job& job : *jobs) {
    if (job.name() == id_or_name) named.push_back(&job);
  }
  if (named.size() == 1) return named.front()->id();
  if (!named.empty()) return Ambiguous(id_or_name, named);
  if (no_such_id) return *no_such_id;
  return MakeError(ErrorCode::kNotFound, "the server at " + client.address() +
                                             " has no job with the id or name " +
                                             Printable(id_or_name) + "; fjord jobs lists them");
}

}  // namespace fjord
