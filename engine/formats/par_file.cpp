#include "engine/formats/par_file.h"

#include <array>
#include <vector>

#include "engine/base/clamp.h"
#include "engine/formats/limits.h"
#include "engine/formats/text.h"

namespace fjord {
namespace {

struct Key {
  std::string_view name;
  std::optional<double> ParFile::*value;
  double lowest;
  double highest;
  bool whole;
  const char* range;  // in words
};

// The largest whole number that every double below it can hold exactly.
constexpr double kMostSeed = 9007199254740992.0;
constexpr double kTiny = 1e-300;

constexpr std::array<Key, 8> kKeys = {{
    {"maxlevel", &ParFile::max_level, 0, 40, true, "a whole number from 0 to 40"},
    {"epsilon", &ParFile::epsilon, kTiny, limits::kCoordinate, false, "greater than 0"},
    {"fixvl", &ParFile::fixvl, 0, 1000, false, "from 0 to 1000"},
    {"seed", &ParFile::seed, 0, kMostSeed, true, "a whole number from 0 to 2^53"},
    {"H-Fdim", &ParFile::H, 0, 1, false, "from 0 to 1"},
    {"sigma", &ParFile::sigma, 0, 1000, false, "from 0 to 1000"},
    {"scale", &ParFile::scale, kTiny, limits::kCoordinate, false, "greater than 0"},
    {"eyedistance", &ParFile::eye_distance, kTiny, limits::kCoordinate, false, "greater than 0"},
}};
// Keys of the older form, in its order.
constexpr std::array<size_t, 5> kPositional = {6, 7, 3, 4, 5};

class ParReader {
 public:
  ParReader(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

  Result<ParFile> Read() {
    while (NextLine()) {
      if (words_[0].text == "parameters" && words_.size() == 1) return ReadKeyed();
      if (first_line_ && text::LooksLikeNumber(words_[0].text)) return ReadPositional();
      first_line_ = false;  // free text before `parameters`
    }
    if (too_long_) return TooLong();
    return Invalid("no line `parameters` and no five numbers (scale, eye distance, seed, H, sigma)",
                   {name_, 0, 0});
  }

 private:
  Place At(size_t word) const {
    return {name_, line_.number, word < words_.size() ? words_[word].column : 1};
  }
  Error Fail(size_t word, std::string message) const {
    return Invalid(std::move(message), At(word));
  }
  Error TooLong() const {
    return MakeError(ErrorCode::kLimit, "a line longer than 64 KiB", {name_, line_.number, 0});
  }

  // The words of the next line that has any, up to a #; = and : between key and value are left out.
  bool NextLine() {
    while (lines_.Next(&line_)) {
      if (line_.text.size() > limits::kHeaderLineBytes) {
        too_long_ = true;
        return false;
      }
      words_.clear();
      text::Words words(line_.text.substr(0, line_.text.find('#')));
      for (text::Word word; words.Next(&word);) {
        if (word.text == "=" || word.text == ":") continue;
        while (word.text.size() > 1 && (word.text.back() == '=' || word.text.back() == ':')) {
          word.text.remove_suffix(1);
        }
        words_.push_back(word);
      }
      if (!words_.empty()) return true;
    }
    return false;
  }

  Result<> Set(const Key& key, size_t word) {
    double value = 0;
    const std::string name(key.name);
    const text::NumberFault fault = text::ParseNumber(words_[word].text, &value);
    if (fault != text::NumberFault::kNone) {
      return Fail(word, name + ": " + text::Explain(fault, words_[word].text));
    }
    const bool whole = Floor(value) == value;
    if (value < key.lowest || value > key.highest || (key.whole && !whole)) {
      return Fail(word,
                  name + " must be " + key.range + ", not " + text::Quoted(words_[word].text));
    }
    if (par_.*key.value) return Fail(word, name + " is given twice");
    par_.*key.value = value;
    return Ok{};
  }

  Result<ParFile> ReadKeyed() {
    bool any = false;
    while (NextLine()) {
      const Key* key = nullptr;
      for (const Key& known : kKeys) {
        if (known.name == words_[0].text) key = &known;
      }
      if (words_[0].text == "H") key = &kKeys[4];
      if (key == nullptr) {
        return Fail(0, text::Quoted(words_[0].text) +
                           " is no parameter; known are maxlevel, epsilon, fixvl, seed, H-Fdim, "
                           "sigma, scale and eyedistance");
      }
      if (words_.size() != 2) {
        return Fail(0, std::string(key->name) + " takes one number");
      }
      if (auto ok = Set(*key, 1); !ok) return ok.error();
      any = true;
    }
    if (too_long_) return TooLong();
    if (!any)
      return Invalid("no parameter follows the line `parameters`", {name_, line_.number, 0});
    return par_;
  }

  Result<ParFile> ReadPositional() {
    size_t read = 0;
    do {
      for (size_t word = 0; word < words_.size(); ++word, ++read) {
        if (read == kPositional.size()) {
          return Fail(word, "more than the five numbers scale, eye distance, seed, H, sigma");
        }
        if (auto ok = Set(kKeys[kPositional[read]], word); !ok) return ok.error();
      }
    } while (NextLine());
    if (too_long_) return TooLong();
    if (read < kPositional.size()) {
      return Invalid("only " + std::to_string(read) +
                         " of the five numbers scale, eye distance, seed, H, sigma",
                     {name_, line_.number, 0});
    }
    return par_;
  }

  text::LineReader lines_;
  const std::string& name_;
  text::Line line_;
  std::vector<text::Word> words_;
  bool first_line_ = true;
  bool too_long_ = false;
  ParFile par_;
};

}  // namespace

Result<ParFile> ReadPar(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) return Invalid("the file is empty; parameters were expected", {name, 0, 0});
  if (bytes.size() > limits::kParBytes) {
    return MakeError(ErrorCode::kLimit, "a parameter file is at most 1 MiB", {name, 0, 0});
  }
  if (text::LooksBinary(bytes)) {
    return Invalid("the file is binary; a .par file is text", {name, 0, 0});
  }
  return ParReader(bytes, name).Read();
}

std::string WritePar(const ParFile& par) {
  std::string out;
  const bool positional = !par.max_level && !par.epsilon && !par.fixvl && par.scale &&
                          par.eye_distance && par.seed && par.H && par.sigma;
  if (positional) {
    for (const size_t key : kPositional) {
      text::Append(*(par.*kKeys[key].value), &out);
      out += '\n';
    }
    return out;
  }
  out = "parameters\n";
  for (const Key& key : kKeys) {
    if (!(par.*key.value)) continue;
    out += std::string(key.name) + ' ';
    text::Append(*(par.*key.value), &out);
    out += '\n';
  }
  return out;
}

}  // namespace fjord
