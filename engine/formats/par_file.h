// The historic parameter file .par (S27), both forms:
//   parameters / keyed values  maxlevel epsilon fixvl seed H-Fdim sigma
//   older: positional          scale, eye distance, seed, H, sigma
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace fjord {

struct ParFile {
  std::optional<double> max_level, epsilon, fixvl, scale, eye_distance, seed, H, sigma;
};

Result<ParFile> ReadPar(std::string_view bytes,
                        const std::string& name);  // H outside 0..1: kInvalid
std::string WritePar(const ParFile& par);

}  // namespace fjord
