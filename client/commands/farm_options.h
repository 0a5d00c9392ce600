// Options that every farm command has.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace fjord {

struct FarmOptions {
  std::string server;
  bool json = false;
};

inline void AddServer(CLI::App* command, FarmOptions* options) {
  command->add_option("--server", options->server,
                      "HOST:PORT; default $FJORD_SERVER, then 127.0.0.1:7433");
}

inline void AddFarmOptions(CLI::App* command, FarmOptions* options) {
  AddServer(command, options);
  command->add_flag("--json", options->json, "JSON on standard output");
}

}  // namespace fjord
