#include "server/state/judge.h"

#include <algorithm>
#include <map>
#include <set>

namespace fjord::server {

Verdict Judge(const std::vector<ResultRow>& evidence, uint32_t required) {
  std::map<std::string, std::set<Digest>> pictures_of;
  for (const ResultRow& result : evidence) pictures_of[result.worker].insert(result.pixel);

  Verdict verdict;
  std::map<Digest, uint32_t> votes;
  for (const auto& [worker, pictures] : pictures_of) {
    if (pictures.size() > 1) {
      verdict.liars.push_back(worker);
    } else {
      ++votes[*pictures.begin()];
    }
  }
  const auto believed = [&](const ResultRow& result) {
    return pictures_of[result.worker].size() == 1;
  };
  if (votes.empty()) {
    verdict.more = required;
    return verdict;
  }
  uint32_t most = 0, voters = 0;
  Digest picture;
  bool tied = false;
  for (const auto& [pixel, count] : votes) {
    voters += count;
    if (count > most) {
      most = count;
      picture = pixel;
      tied = false;
    } else if (count == most) {
      tied = true;
    }
  }
  uint32_t deliveries = 0;
  bool seen = false;
  for (size_t i = 0; i < evidence.size(); ++i) {
    if (evidence[i].pixel != picture || !believed(evidence[i])) continue;
    ++deliveries;
    if (!seen) verdict.winner = i;
    seen = true;
  }
  if (votes.size() == 1) {
    verdict.standing = deliveries >= required ? Standing::kDone : Standing::kOpen;
    verdict.more = deliveries >= required ? 0 : required - deliveries;
    verdict.confirmed = most >= 2;
  } else if (most >= 2 && !tied) {
    verdict.standing = Standing::kDone;
    verdict.more = 0;
    verdict.confirmed = true;
    for (const auto& [worker, pictures] : pictures_of) {
      if (pictures.size() == 1 && *pictures.begin() != picture) verdict.liars.push_back(worker);
    }
    std::sort(verdict.liars.begin(), verdict.liars.end());
  } else {
    verdict.standing = voters >= 3 ? Standing::kNoMajority : Standing::kDisputed;
    verdict.more = voters >= 3 ? 0 : 1;
  }
  return verdict;
}

}  // namespace fjord::server
