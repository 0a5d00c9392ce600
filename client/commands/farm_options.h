// Options that every farm command has.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "client/farm_client.h"

namespace fjord {

struct FarmOptions {
  std::string server;
  std::optional<double> patience;
  bool json = false;

  // One that has never answered is given up soon, one that has is being started again.
  Patience Waiting() const { return {patience.value_or(2), patience.value_or(20)}; }
};

inline void AddServer(CLI::App* command, FarmOptions* options) {
  command->add_option("--server", options->server,
                      "HOST:PORT; default $FJORD_SERVER, then 127.0.0.1:7433");
}

inline void AddPatience(CLI::App* command, FarmOptions* options) {
  command
      ->add_option("--patience", options->patience,
                   "Seconds to wait for a server that does not answer; default 20 where it has "
                   "answered this command before, else 2")
      ->check(CLI::Range(0., 86400.));
}

inline void AddFarmOptions(CLI::App* command, FarmOptions* options) {
  AddServer(command, options);
  command->add_flag("--json", options->json, "JSON on standard output");
}

}  // namespace fjord
