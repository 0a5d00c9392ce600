// ReadJsonForm of read_text.h.
#include <algorithm>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/formats/known_file.h"
#include "engine/scene/limits.h"
#include "engine/scene/read_text.h"

namespace fjord {
namespace {

// Goes over the text and tells how far it has come.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** reached;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    *reached = ++at;
    return *this;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) {
    return a.at == b.at;
  }
  friend bool operator!=(const CountingIterator& a, const CountingIterator& b) {
    return a.at != b.at;
  }
};

// The library's event interface; false stops it.
class JsonReader {
 public:
  JsonReader(const std::string& text, MessageBinder* binder)
      : reached_(text.data()),
        end_(text.data() + text.size()),
        passed_(reached_),
        binder_(binder) {}

  void Read() {
    nlohmann::json::sax_parse(CountingIterator{reached_, &reached_},
                              CountingIterator{end_, &reached_}, this);
  }

  bool null() {  // the same as left out
    Begin();
    return More();
  }
  bool boolean(bool value) { return Give({.text = value ? "true" : "false"}, Begin()); }
  bool number_integer(int64_t value) {
    return Give({WrittenValue::Kind::kNumber, std::to_string(value), static_cast<double>(value)},
                Begin());
  }
  bool number_unsigned(uint64_t value) {
    return Give({WrittenValue::Kind::kNumber, std::to_string(value), static_cast<double>(value),
                 true, value},
                Begin());
  }
  bool number_float(double value, const std::string& text) {
    return Give({WrittenValue::Kind::kNumber, text, value}, Begin());
  }
  bool string(const std::string& value) {
    const TextPlace at = Begin();
    if (depth_ == 1 && in_type_ && IsGeoJsonType(value)) {
      binder_->Refuse(at, "this is GeoJSON (\"type\": \"" + value +
                              "\"), not a scene. A scene has fields such as objects and camera; "
                              "shapes are read from the .std, .obj, .ply and .svg files that it "
                              "names: \"shape\": {\"file\": {\"path\": \"a.svg\"}}");
      return false;
    }
    return Give({WrittenValue::Kind::kText, value}, at);
  }
  bool binary(std::vector<uint8_t>&) { return false; }  // not in text
  bool start_object(size_t) {
    const TextPlace at = Begin();
    if (depth_++ > 0) binder_->BeginGroup(at);
    return DeepEnough(at);
  }
  bool key(const std::string& name) {
    in_type_ = name == "type";
    binder_->Field(name, Begin());
    return More();
  }
  bool end_object() {
    Begin();
    if (--depth_ > 0) binder_->EndGroup();
    return More();
  }
  bool start_array(size_t) {
    const TextPlace at = Begin();
    ++depth_;
    binder_->BeginList(at);
    return DeepEnough(at);
  }
  bool end_array() {
    Begin();
    --depth_;
    binder_->EndList();
    return More();
  }
  bool parse_error(size_t, const std::string&, const nlohmann::json::exception& error) {
    std::string text = error.what();
    const size_t start = text.find("syntax error");
    if (start != std::string::npos) text.erase(0, start);
    for (char& c : text) c = c == '\n' ? ' ' : c;
    PassTo(std::min(reached_, end_));
    binder_->Fail({line_, column_}, "JSON: " + text);
    return false;
  }

 private:
  bool More() const { return !binder_->Full(); }
  bool Give(const WrittenValue& value, TextPlace at) {
    binder_->Value(value, at);
    return More();
  }
  bool DeepEnough(TextPlace at) {
    if (depth_ <= 2 * limits::kMessageDepth) return More();
    binder_->Fail(
        at, "nested too deep; a scene needs less than " + std::to_string(limits::kMessageDepth));
    return false;
  }
  void PassTo(const char* place) {
    for (; passed_ < place; ++passed_) {
      ++column_;
      if (*passed_ == '\n') {
        ++line_;
        column_ = 1;
      }
    }
  }
  // Where the piece that was just read begins: behind the last one, after blanks, commas and
  // colons.
  TextPlace Begin() {
    const char* start = last_;
    const auto is_between = [](char c) {
      return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == ':';
    };
    if (start == nullptr) start = passed_;
    while (start < end_ && is_between(*start)) ++start;
    PassTo(start);
    last_ = reached_;
    return {line_, column_};
  }

  const char* reached_;
  const char* end_;
  const char* passed_;          // as far as line_ and column_
  const char* last_ = nullptr;  // end of the piece before
  int line_ = 1, column_ = 1;
  int depth_ = 0;
  bool in_type_ = false;
  MessageBinder* binder_;
};

}  // namespace

void ReadJsonForm(const std::string& text, MessageBinder* binder) {
  JsonReader(text, binder).Read();
}

}  // namespace fjord
