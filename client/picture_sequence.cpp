#include "client/picture_sequence.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace fjord {
namespace {

constexpr size_t kMostDigits = 18;  // a longer run is no number

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// A file's name cut at its numbers.
struct CutName {
  std::string file;
  std::vector<std::string> texts;  // one more than numbers; the first holds the folder
  std::vector<std::string> digits;
};

CutName Cut(const std::string& file) {
  CutName name{file, {""}, {}};
  const size_t slash = file.find_last_of('/');
  const size_t begin = slash == std::string::npos ? 0 : slash + 1;
  name.texts.back() = file.substr(0, begin);
  for (size_t at = begin; at < file.size();) {
    size_t end = at;
    while (end < file.size() && IsDigit(file[end])) ++end;
    if (end > at && end - at <= kMostDigits) {
      name.digits.push_back(file.substr(at, end - at));
      name.texts.emplace_back();
      at = end;
    } else {
      end = std::max(end, at + 1);
      name.texts.back() += file.substr(at, end - at);
      at = end;
    }
  }
  return name;
}

uint64_t ValueOf(const std::string& digits) { return std::stoull(digits); }

// Which number of these names counts the frames: the last one that is not the same in all.
size_t CounterOf(const std::vector<CutName>& names) {
  const size_t numbers = names.front().digits.size();
  for (size_t place = numbers; place-- > 0;) {
    const uint64_t value = ValueOf(names.front().digits[place]);
    if (std::any_of(names.begin(), names.end(),
                    [&](const CutName& name) { return ValueOf(name.digits[place]) != value; })) {
      return place;
    }
  }
  return numbers - 1;
}

std::string FileNameOf(const std::string& file) {
  const size_t slash = file.find_last_of('/');
  return slash == std::string::npos ? file : file.substr(slash + 1);
}

// The names have the same texts and numbers.
void AddNumbered(const std::vector<CutName>& names, std::vector<PictureSequence>* sequences) {
  const size_t counter = CounterOf(names);
  std::map<std::vector<std::string>, std::vector<PictureSequence::Entry>> parts;
  for (const CutName& name : names) {
    std::vector<std::string> rest = name.digits;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(counter));
    parts[std::move(rest)].push_back({name.file, ValueOf(name.digits[counter])});
  }
  for (auto& [rest, entries] : parts) {
    std::string pattern;
    for (size_t i = 0; i < names.front().texts.size(); ++i) {
      pattern += i == 0 ? FileNameOf(names.front().texts[0]) : names.front().texts[i];
      if (i == names.front().digits.size()) break;
      pattern += i == counter ? "#" : rest[i < counter ? i : i - 1];
    }
    sequences->emplace_back(std::move(pattern), true, std::move(entries));
  }
}

}  // namespace

PictureSequence::PictureSequence(std::string pattern, bool numbered, std::vector<Entry> entries)
    : pattern_(std::move(pattern)), numbered_(numbered), entries_(std::move(entries)) {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.number < b.number; });
}

std::string PictureSequence::Describe() const {
  if (entries_.size() == 1) return FileNameOf(entries_[0].file);
  return pattern_ + " (" + std::to_string(entries_.size()) + ")";
}

std::string PictureSequence::Doubled() const {
  for (size_t i = 1; numbered_ && i < entries_.size(); ++i) {
    if (entries_[i].number == entries_[i - 1].number) {
      return FileNameOf(entries_[i - 1].file) + " and " + FileNameOf(entries_[i].file) +
             " have the same number";
    }
  }
  return {};
}

std::string PictureSequence::Missing(const FrameSet& chosen, size_t most_named) const {
  std::vector<std::pair<uint64_t, uint64_t>> gaps;  // first and last of each
  if (!chosen.empty()) {
    std::set<uint64_t> there;
    for (const Entry& entry : entries_) there.insert(entry.number);
    for (uint32_t index = 0; index < chosen.size(); ++index) {
      const uint64_t number = chosen[index];
      if (numbered_ && there.contains(number)) continue;
      if (!gaps.empty() && gaps.back().second + 1 == number) {
        gaps.back().second = number;
      } else {
        gaps.emplace_back(number, number);
      }
    }
  } else if (numbered_) {
    for (size_t i = 1; i < entries_.size(); ++i) {
      if (entries_[i].number > entries_[i - 1].number + 1) {
        gaps.emplace_back(entries_[i - 1].number + 1, entries_[i].number - 1);
      }
    }
  }
  if (gaps.empty()) return {};
  std::string list;
  for (size_t i = 0; i < gaps.size() && i < most_named; ++i) {
    const auto& [first, last] = gaps[i];
    if (i > 0) list += ',';
    list += std::to_string(first);
    if (last > first) list.append("-").append(std::to_string(last));
  }
  if (gaps.size() > most_named) list += " ...";
  const bool one = gaps.size() == 1 && gaps[0].first == gaps[0].second;
  return (one ? "frame " : "frames ") + list + " of " + pattern_ +
         (one ? " is missing" : " are missing");
}

std::vector<std::string> PictureSequence::Files(const FrameSet& chosen) const {
  std::vector<std::string> files;
  for (const Entry& entry : entries_) {
    const bool wanted = chosen.empty() || (numbered_ && entry.number <= FrameSet::kMostNumber &&
                                           chosen.Contains(static_cast<uint32_t>(entry.number)));
    if (wanted) files.push_back(entry.file);
  }
  return files;
}

std::vector<PictureSequence> SequencesOf(std::vector<std::string> files) {
  std::sort(files.begin(), files.end());
  std::map<std::vector<std::string>, std::vector<CutName>> groups;  // by the texts between numbers
  std::vector<PictureSequence::Entry> plain;
  for (const std::string& file : files) {
    CutName name = Cut(file);
    if (name.digits.empty()) {
      plain.push_back({file, plain.size()});
    } else {
      groups[name.texts].push_back(std::move(name));
    }
  }
  std::vector<PictureSequence> sequences;
  for (const auto& [texts, names] : groups) AddNumbered(names, &sequences);
  if (!plain.empty()) sequences.emplace_back("pictures without a number", false, std::move(plain));
  return sequences;
}

}  // namespace fjord
