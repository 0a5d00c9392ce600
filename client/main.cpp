#include <fcntl.h>
#include <unistd.h>

#include "client/cli.h"
#include "engine/base/fpenv.h"

namespace {

// A standard stream that was closed is /dev/null: else the next file that is opened would take its
// number, and messages would go into a picture.
void KeepStandardStreams() {
  int fd = 0;
  while ((fd = open("/dev/null", O_RDWR)) >= 0 && fd <= STDERR_FILENO) {
  }
  if (fd >= 0) close(fd);
}

}  // namespace

int main(int argc, char** argv) {
  fjord::SetFloatEnvironment();
  KeepStandardStreams();
  return fjord::RunCommandLine(argc, argv);
}
