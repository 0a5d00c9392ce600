#include "engine/formats/par_file.h"
#include "tests/fuzz/harness.h"

namespace fjord::fuzz {

void RunPar(std::string_view bytes) {
  const Result<ParFile> par = ReadPar(bytes, "fuzz");
  if (!par) return;
  FJORD_CHECK(!par->H || (*par->H >= 0 && *par->H <= 1), *par->H);
  const std::string text = WritePar(*par);
  const Result<ParFile> back = ReadPar(text, "again");
  FJORD_CHECK(back.ok(), text);
  FJORD_CHECK(WritePar(*back) == text, text);
}

}  // namespace fjord::fuzz
