// The coordinator's data folder: made if missing, held by a lock while the coordinator lives, so
// that two of them never work on one journal.
#pragma once

#include <memory>
#include <string>

#include "engine/base/result.h"

namespace fjord::server {

class DataDir {
 public:
  static Result<std::unique_ptr<DataDir>> Open(const std::string& path);
  ~DataDir();  // lets the lock go
  DataDir(const DataDir&) = delete;
  DataDir& operator=(const DataDir&) = delete;

  const std::string& path() const { return path_; }

 private:
  DataDir(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}

  const std::string path_;
  const int lock_;
};

}  // namespace fjord::server
