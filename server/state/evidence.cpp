// What is known of keys: the deliveries behind them, by worker and by blob.
#include <algorithm>

#include "server/state/machine.h"

namespace fjord::server {

void Machine::IndexEvidence(const Key& key, const ResultRow& row) {
  evidence_of_[row.worker].insert(key.digest);
  keys_of_blob_[row.blob].insert(key.digest);
}

void Machine::AddEvidence(Key& key, ResultRow row) {
  IndexEvidence(key, row);
  Write(row);
  key.evidence.push_back(std::move(row));
}

// The caller settles the key.
template <typename Predicate>
void Machine::DropEvidence(Key& key, Predicate drops) {
  const auto kept = std::stable_partition(key.evidence.begin(), key.evidence.end(),
                                          [&](const ResultRow& row) { return !drops(row); });
  for (auto row = kept; row != key.evidence.end(); ++row) {
    Write(DropResult{row->key, row->attempt, row->worker, row->pixel});
    const auto forget = [&](auto& index, const auto& name) {
      const auto place = index.find(name);
      if (place == index.end()) return;
      place->second.erase(key.digest);
      if (place->second.empty()) index.erase(place);
    };
    forget(evidence_of_, row->worker);
    forget(keys_of_blob_, row->blob);
  }
  key.evidence.erase(kept, key.evidence.end());
  for (const ResultRow& row : key.evidence) IndexEvidence(key, row);
}

void Machine::DropAllEvidence(Key& key) {
  DropEvidence(key, [](const ResultRow&) { return true; });
}

void Machine::DropEvidenceOf(Key& key, const std::string& worker) {
  DropEvidence(key, [&](const ResultRow& row) { return row.worker == worker; });
}

void Machine::BlobsLost(const std::vector<Digest>& blobs, Now now) {
  for (const Digest& blob : blobs) {
    const auto place = keys_of_blob_.find(blob);
    if (place == keys_of_blob_.end()) continue;
    const std::set<Digest> keys = place->second;
    for (const Digest& digest : keys) {
      Key& key = keys_.at(digest);
      if (key.done())
        key.hold_until_ms = 0;  // nobody was rendering it when the coordinator started
      DropEvidence(key, [&](const ResultRow& row) { return row.blob == blob; });
      Settle(key, now);
    }
  }
  Finish(now);
}

}  // namespace fjord::server
