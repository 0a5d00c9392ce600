// XmlDocument::Read: the callbacks of Expat.
#include <expat.h>

#include <algorithm>
#include <array>
#include <memory>

#include "engine/formats/limits.h"
#include "engine/formats/text.h"
#include "engine/formats/xml_document.h"

namespace fjord::formats {
namespace {

constexpr size_t kPieceBytes = size_t{16} << 20;  // given to Expat at once, which copies it

std::string Advice(XML_Error code, unsigned char byte) {
  switch (code) {
    case XML_ERROR_NO_ELEMENTS:
    case XML_ERROR_UNCLOSED_TOKEN:
    case XML_ERROR_UNCLOSED_CDATA_SECTION:
    case XML_ERROR_PARTIAL_CHAR:
      return "; the file is cut short";
    case XML_ERROR_UNDEFINED_ENTITY:
    case XML_ERROR_EXTERNAL_ENTITY_HANDLING:
    case XML_ERROR_ATTRIBUTE_EXTERNAL_ENTITY_REF:
      return "; write its text in its place, nothing is fetched from elsewhere";
    case XML_ERROR_INVALID_TOKEN:
      return byte < 0x80 ? "" : "; save as UTF-8, or declare the file's encoding";
    case XML_ERROR_UNBOUND_PREFIX:
      return "; declare it as xmlns:PREFIX=\"...\"";
    default:
      return "";
  }
}

bool IsPredefined(std::string_view name) {
  constexpr std::array<std::string_view, 5> kNames = {"lt", "gt", "amp", "quot", "apos"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

}  // namespace

class XmlLoader {
 public:
  XmlLoader(std::string_view bytes, const std::string& name, std::string_view text_of)
      : document_(bytes, name),
        text_of_(text_of),
        parser_(XML_ParserCreateNS(nullptr, ' '), &XML_ParserFree) {
    FJORD_CHECK(parser_ != nullptr);
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &OnOpen, &OnClose);
    XML_SetCharacterDataHandler(parser_.get(), &OnText);
    XML_SetEntityDeclHandler(parser_.get(), &OnEntity);
    XML_SetDoctypeDeclHandler(parser_.get(), &OnDoctype, &OnDoctypeEnd);
    XML_SetSkippedEntityHandler(parser_.get(), &OnSkipped);
    XML_SetExternalEntityRefHandler(parser_.get(), &OnExternal);
    XML_SetUnknownEncodingHandler(parser_.get(), &OnEncoding, nullptr);
  }

  Result<XmlDocument> Read() {
    // Blanks before a declaration are not well-formed, but stand in files of hand-made scripts.
    const std::string_view bytes = document_.bytes_;
    skipped_ = document_.unit_ == 1 ? bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF") : 0;
    skipped_ = std::min(skipped_, bytes.size());
    for (size_t at = skipped_; at <= bytes.size(); at += kPieceBytes) {
      const std::string_view piece = bytes.substr(at, kPieceBytes);
      const bool last = bytes.size() - at <= kPieceBytes;
      const XML_Status status =
          XML_Parse(parser_.get(), piece.data(), static_cast<int>(piece.size()), last);
      if (!error_.message.empty()) return error_;
      if (status != XML_STATUS_OK) return Fault();
      if (last) break;
    }
    return std::move(document_);
  }

 private:
  static XmlLoader* Self(void* data) { return static_cast<XmlLoader*>(data); }

  size_t Offset() const {
    const XML_Index index = XML_GetCurrentByteIndex(parser_.get());
    return std::min(skipped_ + static_cast<size_t>(index < 0 ? 0 : index), document_.bytes_.size());
  }

  void Stop(Error error) {
    if (error_.message.empty()) error_ = std::move(error);
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  Error Fault() const {
    const XML_Error code = XML_GetErrorCode(parser_.get());
    const size_t at = Offset();
    const Place place = document_.At(at);
    if (code == XML_ERROR_AMPLIFICATION_LIMIT_BREACH) {
      return MakeError(ErrorCode::kLimit, "entities grow to more than 100 times the file", place);
    }
    if (code == XML_ERROR_NO_ELEMENTS && !open_.empty()) {
      return Invalid("the file ends inside <" + Name(open_.back()) + ">; it is cut short", place);
    }
    if (code == XML_ERROR_TAG_MISMATCH && !open_.empty()) {
      const XmlElement& open = document_.elements_[open_.back()];
      return Invalid("an end that does not belong to <" + Name(open_.back()) + "> of line " +
                         std::to_string(document_.PlaceOf(open).line) + ", which is still open",
                     place);
    }
    const auto byte =
        static_cast<unsigned char>(at < document_.bytes_.size() ? document_.bytes_[at] : 0);
    return Invalid(std::string("no good XML: ") + XML_ErrorString(code) + Advice(code, byte),
                   place);
  }

  std::string Name(size_t element) const {
    return text::OneLine(document_.elements_[element].name.substr(0, 40));
  }

  std::string_view Interned(std::string_view name) {
    const auto found = document_.names_.find(name);
    return found != document_.names_.end() ? *found
                                           : *document_.names_.insert(std::string(name)).first;
  }

  // Expat writes a name of a namespace as "namespace name".
  static void OnOpen(void* data, const XML_Char* name, const XML_Char** attributes) {
    Self(data)->Open(name, attributes);
  }
  void Open(std::string_view name, const XML_Char** attributes) {
    if (!error_.message.empty()) return;
    XmlDocument& d = document_;
    XmlElement element;
    element.offset = Offset();
    element.bytes = static_cast<size_t>(XML_GetCurrentByteCount(parser_.get()));
    if (open_.size() >= limits::kDepth) {
      return Stop(MakeError(ErrorCode::kLimit, "more than 64 elements within each other",
                            d.At(element.offset)));
    }
    if (outside_ && !CheckReferences(d.Ascii(element.offset, element.bytes), element.offset))
      return;
    const size_t blank = name.rfind(' ');
    element.space = Interned(blank == name.npos ? "" : name.substr(0, blank));
    element.name = Interned(blank == name.npos ? name : name.substr(blank + 1));
    element.attributes = d.attributes_.size();
    for (; *attributes != nullptr; attributes += 2) {
      std::string_view attribute = attributes[0];
      if (attribute == "http://www.w3.org/1999/xlink href") attribute = "xlink:href";
      if (attribute.find(' ') != attribute.npos) continue;
      const std::string_view value = attributes[1];
      d.attributes_.push_back({Interned(attribute), d.text_.size(), value.size()});
      d.text_ += value;
    }
    element.attribute_count = d.attributes_.size() - element.attributes;
    open_.push_back(d.elements_.size());
    d.elements_.push_back(element);
    if (d.elements_.size() + d.attributes_.size() > limits::kXmlItems) {
      Stop(MakeError(ErrorCode::kLimit, "more than 16,000,000 elements and attributes",
                     d.At(element.offset)));
    }
    if (d.text_.size() > limits::kFileBytes) {
      Stop(MakeError(ErrorCode::kLimit, "attributes of more than 1 GiB", d.At(element.offset)));
    }
  }

  static void OnClose(void* data, const XML_Char*) {
    XmlLoader* self = Self(data);
    if (self->open_.empty()) return;
    self->document_.elements_[self->open_.back()].end = self->document_.elements_.size();
    self->open_.pop_back();
  }

  static void OnText(void* data, const XML_Char* text, int size) {
    XmlLoader* self = Self(data);
    if (self->open_.empty()) return;
    const size_t element = self->open_.back();
    if (self->document_.elements_[element].name != self->text_of_) return;
    self->kept_ += static_cast<size_t>(size);
    if (self->kept_ > limits::kLineBytes) {
      return self->Stop(MakeError(ErrorCode::kLimit, "style sheets of more than 16 MiB",
                                  self->document_.At(self->Offset())));
    }
    self->document_.texts_[element].append(text, static_cast<size_t>(size));
  }

  // With a DTD elsewhere an entity that the file does not declare is no error of Expat's: it would
  // vanish from attributes without a word.
  static void OnDoctype(void* data, const XML_Char*, const XML_Char* system, const XML_Char*, int) {
    Self(data)->outside_ = system != nullptr;
  }
  static void OnEntity(void* data, const XML_Char* name, int parameter, const XML_Char* value,
                       int size, const XML_Char*, const XML_Char*, const XML_Char*,
                       const XML_Char*) {
    XmlLoader* self = Self(data);
    if (parameter != 0) self->outside_ = true;
    if (parameter != 0 || value == nullptr) return;
    self->declared_.insert(name);
    self->values_.append(value, static_cast<size_t>(size)).push_back(' ');
  }
  static void OnDoctypeEnd(void* data) {
    XmlLoader* self = Self(data);
    if (self->outside_) self->CheckReferences(self->values_, self->Offset());
  }
  static void OnSkipped(void* data, const XML_Char* name, int parameter) {
    if (parameter != 0) return;
    Self(data)->Undeclared(name, Self(data)->Offset());
  }
  static int OnExternal(XML_Parser, const XML_Char* context, const XML_Char*, const XML_Char*,
                        const XML_Char*) {
    return context == nullptr ? XML_STATUS_OK : XML_STATUS_ERROR;
  }

  bool CheckReferences(std::string_view text, size_t offset) {
    for (size_t at = text.find('&'); at != text.npos; at = text.find('&', at + 1)) {
      const std::string_view name = text.substr(at + 1, text.find(';', at) - at - 1);
      if (name.empty() || name[0] == '#' || IsPredefined(name)) continue;
      if (declared_.find(name) != declared_.end()) continue;
      Undeclared(name, std::min(offset + at * document_.unit_, document_.bytes_.size()));
      return false;
    }
    return true;
  }

  void Undeclared(std::string_view name, size_t offset) {
    Stop(Invalid("the entity " + text::Quoted(name) +
                     " is not declared in this file; write its text in its place",
                 document_.At(offset)));
  }

  // Bytes below 128 are ASCII in all that is likely; of the others nothing hangs but that equal
  // names stay equal.
  static int OnEncoding(void*, const XML_Char*, XML_Encoding* encoding) {
    for (int byte = 0; byte < 256; ++byte) encoding->map[byte] = byte;
    encoding->data = nullptr;
    encoding->convert = nullptr;
    encoding->release = nullptr;
    return XML_STATUS_OK;
  }

  XmlDocument document_;
  const std::string_view text_of_;
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_;
  size_t skipped_ = 0;
  bool outside_ = false;  // declarations may stand where nobody looks
  std::set<std::string, std::less<>> declared_;
  std::string values_;  // of the declared entities
  std::vector<size_t> open_;
  size_t kept_ = 0;
  Error error_;
};

Result<XmlDocument> XmlDocument::Read(std::string_view bytes, const std::string& name,
                                      std::string_view text_of) {
  return XmlLoader(bytes, name, text_of).Read();
}

}  // namespace fjord::formats
