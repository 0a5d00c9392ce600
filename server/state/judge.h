// Judges what was delivered for one key, from the evidence alone (F3). Pure.
//
// J1 Votes are counted by distinct worker; a worker's repeated agreement is one vote.
// J2 One picture only: settled once `required` deliveries stand behind it.
// J3 Several pictures: settled by the one that most workers made, if at least two did and no other
//    has as many; the workers behind the others are liars.
// J4 Three workers or more and no such picture: nobody can be believed, the key fails as INTEGRITY.
// J5 A worker that delivered two different pictures contradicts itself: it is a liar whatever the
//    others say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/state/types.h"

namespace fjord::server {

enum class Standing : uint8_t {
  kOpen,      // needs `more` deliveries from anyone
  kDone,      // `winner` is the picture
  kDisputed,  // needs one delivery from a worker that has not voted
  kNoMajority,
};

struct Verdict {
  Standing standing = Standing::kOpen;
  uint32_t more = 1;
  size_t winner = 0;               // kDone: index of the first evidence for the picture
  bool confirmed = false;          // kDone: two distinct workers stand behind it
  std::vector<std::string> liars;  // sorted
};

Verdict Judge(const std::vector<ResultRow>& evidence, uint32_t required);

}  // namespace fjord::server
