// Fills a message from what a reader of text or JSON finds, piece by piece, in the order of the
// file: one code for both forms, so that they mean the same and have the same errors. It knows the
// fields of the messages and, in messages that stand for an entry of a registry, the entries'
// knobs.
//
// A defect is noted with its place and what it belongs to is passed over, so that one run finds all
// of them. Not thread-safe.
#pragma once

#include <google/protobuf/message.h>

#include <array>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/scene/entry_kinds.h"
#include "engine/scene/places.h"

namespace fjord {

// A single value as it is written.
struct WrittenValue {
  enum class Kind { kWord, kText, kNumber };
  Kind kind = Kind::kWord;
  std::string text;  // as written, texts without their quotes
  double number = 0;
  bool is_whole = false;  // from 0, below 2^64
  uint64_t whole = 0;
};

class MessageBinder {
 public:
  // `places` may be null. `json`: numbers may stand in quotes.
  MessageBinder(google::protobuf::Message* root, std::string file, bool json, PlaceTree* places);

  // The name of a field; what follows is its value.
  void Field(const std::string& name, TextPlace at);
  void BeginGroup(TextPlace at);
  void EndGroup();
  void BeginList(TextPlace at);
  void EndList();
  void Value(const WrittenValue& value, TextPlace at);

  void Fail(TextPlace at, const std::string& message);
  // The whole file is something else: this error stands for all others.
  void Refuse(TextPlace at, const std::string& message);
  // There are as many errors as are reported at once, or the nesting is too deep: stop reading.
  bool Full() const { return full_; }
  Errors Take() { return std::move(errors_); }

 private:
  // What is being filled: a group's message, or the numbers of a vector or colour.
  struct Level {
    google::protobuf::Message* message = nullptr;  // null: numbers
    const EntryKind* kind = nullptr;
    int node = PlaceTree::kRoot;
    std::vector<std::string> given;
    RouteStep target;  // the field whose value comes next; field null: none, pass over
    std::string name;  // of the target
    TextPlace place;   // of that name
    bool in_list = false;
    std::string_view parts;  // numbers as a group: "xyz" or "rgb"; as a list: empty
    std::vector<double> numbers;
  };

  Level& top() { return levels_.back(); }
  bool Push(Level level, TextPlace at);
  bool TakesNumbers(const Level& level) const;
  void BeginNumbers(std::string_view parts, TextPlace at);
  void EndNumbers();
  int AddPlace(TextPlace at);
  void PutKnob(const WrittenValue& value, TextPlace at);
  void PutField(const WrittenValue& value, TextPlace at);
  bool ToNumber(const WrittenValue& value, double* number) const;
  bool ToWhole(const WrittenValue& value, uint64_t most, uint64_t* whole) const;
  v1::Parameter* OpenParameter();
  void Mismatch(const WrittenValue& value, const std::string& wanted, TextPlace at);

  std::string file_;
  bool json_;
  PlaceTree* places_;
  std::vector<Level> levels_;
  int passing_ = 0;  // depth of groups and lists that are passed over
  Errors errors_;
  bool full_ = false;
};

}  // namespace fjord
