#include "engine/scene/read_text.h"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <limits>

#include "engine/scene/limits.h"

namespace fjord {
namespace {

using google::protobuf::io::Tokenizer;

class TextReader : public google::protobuf::io::ErrorCollector {
 public:
  TextReader(const std::string& text, MessageBinder* binder)
      : binder_(binder),
        stream_(text.data(), static_cast<int>(text.size())),
        tokens_(&stream_, this) {
    tokens_.set_allow_f_after_float(true);
    tokens_.set_comment_style(Tokenizer::SH_COMMENT_STYLE);
    tokens_.set_require_space_after_number(false);
    tokens_.set_allow_multiline_strings(true);
  }

  void Read() {
    Next();
    ReadFields("", {});
  }

  // The tokens' own defects: a text without its end, a byte that nothing begins with.
  void AddError(int line, int column, const std::string& message) override {
    Stop({line + 1, column + 1}, message);
  }

 private:
  const Tokenizer::Token& token() const { return *token_; }
  TextPlace here() const { return {token().line + 1, token().column + 1}; }
  bool Is(const char* symbol) const {
    return token().type == Tokenizer::TYPE_SYMBOL && token().text == symbol;
  }
  void Next() { tokens_.Next(); }
  bool Stopped() const { return stopped_ || binder_->Full(); }
  void Stop(TextPlace at, const std::string& message) {
    if (!stopped_) binder_->Fail(at, message);
    stopped_ = true;
  }
  std::string Shown() const {
    if (token().type == Tokenizer::TYPE_END) return "the end of the file";
    return token().text.substr(0, 40);
  }

  // Fields up to the symbol `end`, or the end of the file where it is empty.
  void ReadFields(const std::string& end, TextPlace opened) {
    while (!Stopped()) {
      if (token().type == Tokenizer::TYPE_END) {
        if (!end.empty()) {
          Stop(here(), "the group that begins at line " + std::to_string(opened.line) +
                           ", column " + std::to_string(opened.column) + " has no " + end);
        }
        return;
      }
      if (!end.empty() && Is(end.c_str())) return;
      if (token().type != Tokenizer::TYPE_IDENTIFIER)
        return Stop(here(), "a field's name is expected, not " + Shown());
      binder_->Field(token().text, here());
      const std::string name = token().text;
      Next();
      const bool colon = Is(":");
      if (colon) Next();
      if (!colon && !Is("{") && !Is("<"))
        return Stop(here(), "a : is missing between " + name + " and " + Shown());
      ReadValue();
      if (Is(",") || Is(";")) Next();
    }
  }

  void ReadValue() {
    if (Is("{") || Is("<")) return ReadGroup();
    if (Is("[")) return ReadList();
    const TextPlace at = here();
    WrittenValue value;
    if (token().type == Tokenizer::TYPE_STRING) {
      value.kind = WrittenValue::Kind::kText;
      while (token().type == Tokenizer::TYPE_STRING) {
        Tokenizer::ParseStringAppend(token().text, &value.text);
        Next();
      }
      return binder_->Value(value, at);
    }
    const bool negative = Is("-");
    if (negative) Next();
    value.text = negative ? "-" + token().text : token().text;
    if (token().type == Tokenizer::TYPE_IDENTIFIER) {
      if (!ReadNotFinite(negative, &value) && negative)
        return Stop(at, "a number is expected after -, not " + Shown());
    } else if (token().type == Tokenizer::TYPE_INTEGER || token().type == Tokenizer::TYPE_FLOAT) {
      value.kind = WrittenValue::Kind::kNumber;
      value.is_whole =
          token().type == Tokenizer::TYPE_INTEGER &&
          Tokenizer::ParseInteger(token().text, std::numeric_limits<uint64_t>::max(), &value.whole);
      value.number =
          value.is_whole ? static_cast<double>(value.whole) : Tokenizer::ParseFloat(token().text);
      value.is_whole = value.is_whole && (!negative || value.whole == 0);
      if (negative) value.number = -value.number;
    } else {
      return Stop(at, "a value is expected, not " + Shown());
    }
    Next();
    binder_->Value(value, at);
  }

  // inf and nan, so that they are refused as numbers.
  bool ReadNotFinite(bool negative, WrittenValue* value) const {
    const std::string& text = token().text;
    const bool infinite = text == "inf" || text == "infinity";
    if (!infinite && text != "nan") return false;
    const double number = infinite ? std::numeric_limits<double>::infinity()
                                   : std::numeric_limits<double>::quiet_NaN();
    value->kind = WrittenValue::Kind::kNumber;
    value->number = negative ? -number : number;
    return true;
  }

  void ReadGroup() {
    const TextPlace at = here();
    const std::string end = Is("{") ? "}" : ">";
    if (!Deepen(at)) return;
    binder_->BeginGroup(at);
    Next();
    ReadFields(end, at);
    if (Stopped()) return;
    Next();
    binder_->EndGroup();
    --depth_;
  }

  void ReadList() {
    if (!Deepen(here())) return;
    binder_->BeginList(here());
    Next();
    while (!Stopped() && !Is("]")) {
      ReadValue();
      if (Is(",")) {
        Next();
      } else if (!Is("]")) {
        return Stop(here(), "a , or ] is expected in the list, not " + Shown());
      }
    }
    if (Stopped()) return;
    Next();
    binder_->EndList();
    --depth_;
  }

  bool Deepen(TextPlace at) {
    if (++depth_ <= limits::kMessageDepth) return true;
    Stop(at, "nested too deep; a scene needs less than " + std::to_string(limits::kMessageDepth));
    return false;
  }

  MessageBinder* binder_;
  google::protobuf::io::ArrayInputStream stream_;
  Tokenizer tokens_;
  const Tokenizer::Token* token_ = &tokens_.current();
  int depth_ = 0;
  bool stopped_ = false;
};

}  // namespace

void ReadTextForm(const std::string& text, MessageBinder* binder) {
  TextReader(text, binder).Read();
}

}  // namespace fjord
