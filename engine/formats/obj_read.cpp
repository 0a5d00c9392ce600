// Reading Wavefront .obj: v (with w or colours after it), f in all its forms, l, negative indices,
// lines continued with a backslash. Lines of two points join into curves. Texture coordinates,
// normals, groups and materials are passed over; free-form curves and surfaces, and what is not in
// the file, are refused by name.
#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "engine/formats/limits.h"
#include "engine/formats/readers.h"
#include "engine/formats/text.h"
#include "engine/geometry/join_edges.h"

namespace fjord::formats {
namespace {

using text::NumberFault;

template <size_t n>
bool IsOneOf(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Statements that end in the name of a file or thing, which may end in a backslash.
constexpr std::array<std::string_view, 8> kNaming = {"mtllib", "maplib",     "usemap",    "usemtl",
                                                     "o",      "shadow_obj", "trace_obj", "g"};
constexpr std::array<std::string_view, 12> kPassedOver = {
    "vt", "vn", "s", "mg", "bevel", "lod", "c_interp", "d_interp", "ctech", "stech", "vp", "p"};
constexpr std::array<std::string_view, 7> kFreeForm = {"curv", "curv2", "surf", "bsp",
                                                       "bzp",  "cdc",   "cdp"};
// Alone these draw nothing.
constexpr std::array<std::string_view, 12> kFreeFormParts = {
    "cstype", "bmat", "con", "deg", "step", "parm", "trim", "hole", "scrv", "sp", "end", "res"};
constexpr std::array<std::string_view, 6> kTaken = {"v", "f", "fo", "l", "call", "csh"};

bool IsStatement(std::string_view word) {
  return IsOneOf(word, kTaken) || IsOneOf(word, kNaming) || IsOneOf(word, kPassedOver) ||
         IsOneOf(word, kFreeForm) || IsOneOf(word, kFreeFormParts);
}

std::string_view FirstWord(std::string_view line) {
  text::Words words(line);
  text::Word word;
  return words.Next(&word) ? word.text : std::string_view();
}

// Where a line's comment begins. The sign in 1.#IND, 1.#INF and 1.#QNAN, which some C libraries
// print for what is no number, begins none: the vertex would lose that it is bad.
size_t CommentOf(std::string_view line) {
  size_t at = line.find('#');
  while (at != line.npos && at >= 2 && line.substr(at - 2, 2) == "1." && at + 1 < line.size() &&
         std::string_view("IQSiqs").find(line[at + 1]) != std::string_view::npos) {
    at = line.find('#', at + 1);
  }
  return at;
}

// A line without its comment and the blanks at its end. A comment ends with its line, whatever it
// ends in, and blanks may follow the backslash that joins the next line.
std::string_view Statement(std::string_view line) {
  line = line.substr(0, CommentOf(line));
  return line.substr(0, line.find_last_not_of(" \t\v\f") + 1);
}

bool IsContinued(std::string_view statement) {
  return !statement.empty() && statement.back() == '\\';
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

  Result<ShapeFile> Read() {
    text::Line line;
    std::string joined;
    while (lines_.Next(&line)) {
      line_ = line.number;
      std::string_view content = Statement(line.text);
      // A name may end in a backslash, as folders do: what follows such a line and is a statement
      // stands for itself.
      if (IsContinued(content) && IsOneOf(FirstWord(content), kNaming)) {
        text::LineReader ahead = lines_;
        text::Line next;
        if (!ahead.Next(&next) || IsStatement(FirstWord(next.text))) continue;
      }
      if (IsContinued(content)) {
        joined.clear();
        while (IsContinued(content)) {
          joined.append(content.substr(0, content.size() - 1)).push_back(' ');
          if (joined.size() > limits::kLineBytes) return LineTooLong(At(1));
          content = lines_.Next(&line) ? Statement(line.text) : std::string_view();
        }
        content = joined.append(content);
      }
      if (content.size() > limits::kLineBytes) return LineTooLong(At(1));
      if (auto ok = ReadLine(content); !ok) return ok.error();
    }
    return Finish();
  }

 private:
  struct Forward {
    int64_t index;  // from 0
    Place place;
  };

  Place At(int column) const { return {name_, line_, column}; }
  Error Fail(int column, std::string message) const {
    return Invalid(std::move(message), At(column));
  }

  Result<> ReadLine(std::string_view content) {
    text::Words words(content);
    text::Word word;
    if (!words.Next(&word)) return Ok{};
    if (word.text == "v") return ReadVertex(&words);
    if (word.text == "f" || word.text == "fo") return ReadElement(&words, true);
    if (word.text == "l") return ReadElement(&words, false);
    if (word.text == "p")
      Note(word, &points_said_, "points (p) are passed over: they are no curve");
    if (word.text == "vp") {
      Note(word, &parameters_said_, "vp belongs to free-form curves and is passed over");
    }
    if (IsOneOf(word.text, kPassedOver) || IsOneOf(word.text, kNaming) ||
        IsOneOf(word.text, kFreeFormParts)) {
      return Ok{};
    }
    if (word.text == "call" || word.text == "csh") {
      return Fail(word.column, std::string(word.text) +
                                   " takes in what another file or program says, which is not "
                                   "done; put its statements here");
    }
    if (IsOneOf(word.text, kFreeForm)) {
      return Fail(word.column, "free-form curves and surfaces (" + std::string(word.text) +
                                   ") are not read; turn them into polygons first");
    }
    return Fail(word.column, text::Quoted(word.text) + " is no statement of a Wavefront .obj file");
  }

  // Said once a file.
  void Note(const text::Word& word, bool* said, const char* message) {
    if (!*said) shape_.notes.push_back({At(word.column), message});
    *said = true;
  }

  Result<> ReadVertex(text::Words* words) {
    std::array<double, 7> number{};
    size_t count = 0;
    text::Word word;
    const std::string name = "vertex " + std::to_string(points_.size() + 1);
    while (words->Next(&word)) {
      if (count == number.size()) return Fail(word.column, name + " has more than seven numbers");
      const NumberFault fault = text::ParseNumber(word.text, &number[count++]);
      if (fault != NumberFault::kNone) {
        return Fail(word.column, name + ": " + text::Explain(fault, word.text));
      }
    }
    if (count < 3 || count == 5) {
      return Fail(words->column(),
                  name + " has " + std::to_string(count) + " numbers; write x y z, or x y z r g b");
    }
    if (points_.size() >= limits::kVertices) return TooManyVertices(At(1));
    points_.push_back({number[0], number[1], number[2]});
    vertex_line_.push_back(line_);
    if (count >= 6) {
      colors_.resize(points_.size() - 1, Rgb(1));
      if (count == 7) {
        return Fail(words->column(), name +
                                         " has seven numbers, and the fourth may be a weight or "
                                         "the seventh an alpha; write x y z r g b");
      }
      for (size_t k = 3; k < 6; ++k) {
        if (number[k] < 0 || number[k] > 1) {
          return Fail(words->column(), name + " has a colour that is not within 0 to 1");
        }
      }
      colors_.push_back(Rgb(static_cast<float>(number[3]), static_cast<float>(number[4]),
                            static_cast<float>(number[5])));
    }
    return Ok{};
  }

  // `7`, `7/1`, `7//3` or `7/1/3`, each number also negative: counted back from the last vertex.
  Result<> ReadCorner(const text::Word& word, uint32_t* vertex) {
    const std::string_view first = word.text.substr(0, word.text.find('/'));
    int64_t index = 0;
    if (text::ParseInteger(first, &index) != NumberFault::kNone) {
      return Fail(word.column, text::Quoted(word.text) + " is no vertex number");
    }
    int64_t ignored = 0;
    int slashes = 0;
    for (size_t at = first.size(); at < word.text.size(); ++slashes) {
      const size_t end = std::min(word.text.find('/', at + 1), word.text.size());
      const std::string_view part = word.text.substr(at + 1, end - at - 1);
      if (slashes == 2 ||
          (!part.empty() && text::ParseInteger(part, &ignored) != NumberFault::kNone)) {
        return Fail(word.column, text::Quoted(word.text) +
                                     " is no corner; write v, v/vt, v//vn or "
                                     "v/vt/vn");
      }
      at = end;
    }
    if (index == 0) return Fail(word.column, "vertex 0: vertices count from 1");
    const int64_t have = static_cast<int64_t>(points_.size());
    if (index < -have) {
      return Fail(word.column, "vertex " + std::to_string(index) +
                                   " is before the first; there are " + std::to_string(have) +
                                   " so far");
    }
    index = index < 0 ? have + index : index - 1;
    if (index >= static_cast<int64_t>(limits::kVertices)) {
      return Fail(word.column,
                  "names vertex " + std::to_string(index + 1) + ", more than a file may hold");
    }
    // A vertex may follow its use. The first bad one in the file is among the growing maxima.
    if (index >= have && (forward_.empty() || index > forward_.back().index)) {
      forward_.push_back({index, At(word.column)});
    }
    *vertex = static_cast<uint32_t>(index);
    return Ok{};
  }

  Result<> ReadElement(text::Words* words, bool face) {
    std::vector<uint32_t>& list = face ? shape_.mesh.face_vertex : curve_vertex_;
    const size_t begin = list.size();
    text::Word word;
    while (words->Next(&word)) {
      if (list.size() >= limits::kIndices) return TooManyIndices(At(word.column));
      uint32_t vertex = 0;
      if (auto ok = ReadCorner(word, &vertex); !ok) return ok.error();
      list.push_back(vertex);
    }
    const size_t count = list.size() - begin;
    if (count < (face ? 3u : 2u)) {
      return Fail(words->column(), std::string(face ? "a face" : "a line") + " has " +
                                       std::to_string(count) + " vertices; at least " +
                                       (face ? "3" : "2") + " are needed");
    }
    if (face) {
      shape_.mesh.face_size.push_back(static_cast<uint32_t>(count));
      shape_.face_line.push_back(line_);
    } else {
      if (curve_size_.size() >= limits::kCurves) {
        return MakeError(ErrorCode::kLimit, "more than 4,000,000 lines", At(1));
      }
      curve_size_.push_back(count);
    }
    return Ok{};
  }

  Result<ShapeFile> Finish() {
    for (const Forward& forward : forward_) {
      if (forward.index >= static_cast<int64_t>(points_.size())) {
        return Invalid("names vertex " + std::to_string(forward.index + 1) + "; the file has " +
                           std::to_string(points_.size()),
                       forward.place);
      }
    }
    if (shape_.mesh.face_size.empty() && curve_size_.empty()) {
      return Invalid("the file has vertices, but no face (f) and no line (l); is it cut short?",
                     {name_, lines_.line_number(), 0});
    }
    if (!colors_.empty()) colors_.resize(points_.size(), Rgb(1));
    if (auto ok = MakeCurves(); !ok) return ok.error();
    KeepMeshPoints();
    return std::move(shape_);
  }

  Result<> MakeCurves() {
    if (curve_vertex_.size() > limits::kVertices + curve_size_.size()) {
      return TooManyVertices({name_, 0, 0});
    }
    std::vector<std::array<uint32_t, 2>> pieces;  // lines of two points, which join
    size_t begin = 0;
    for (const size_t size : curve_size_) {
      if (size == 2) pieces.push_back({curve_vertex_[begin], curve_vertex_[begin + 1]});
      begin += size;
    }
    const std::vector<Chain> chains = JoinEdges(pieces, points_.size());
    begin = 0;
    size_t piece = 0, chain = 0;
    for (const size_t size : curve_size_) {
      if (size > 2) {
        const bool closed = size > 3 && curve_vertex_[begin] == curve_vertex_[begin + size - 1];
        AddCurve(std::span(curve_vertex_).subspan(begin, size - (closed ? 1 : 0)), closed);
      } else if (chain < chains.size() && chains[chain].first == piece++) {
        AddCurve(chains[chain].vertices, chains[chain].closed);
        ++chain;
      }
      begin += size;
    }
    return Ok{};
  }

  void AddCurve(std::span<const uint32_t> vertices, bool closed) {
    Polyline curve;
    curve.closed = closed;
    for (const uint32_t v : vertices) curve.points.push_back(points_[v]);
    shape_.curves.push_back(std::move(curve));
  }

  // Vertices that only lines use belong to the curves; all others, used or not, to the mesh.
  void KeepMeshPoints() {
    if (shape_.mesh.face_size.empty()) return;
    std::vector<uint8_t> drop(points_.size(), 0);
    for (const uint32_t v : curve_vertex_) drop[v] = 1;
    for (const uint32_t v : shape_.mesh.face_vertex) drop[v] = 0;
    std::vector<uint32_t> number(points_.size());
    for (size_t v = 0; v < points_.size(); ++v) {
      if (drop[v]) continue;
      number[v] = static_cast<uint32_t>(shape_.mesh.points.size());
      shape_.mesh.points.push_back(points_[v]);
      shape_.vertex_line.push_back(vertex_line_[v]);
      if (!colors_.empty()) shape_.mesh.colors.push_back(colors_[v]);
    }
    for (uint32_t& v : shape_.mesh.face_vertex) v = number[v];
  }

  text::LineReader lines_;
  const std::string& name_;
  int line_ = 0;
  std::vector<Vec3> points_;
  std::vector<int> vertex_line_;
  std::vector<Rgb> colors_;  // none, or of the first vertices
  std::vector<uint32_t> curve_vertex_;
  std::vector<size_t> curve_size_;
  std::vector<Forward> forward_;
  bool points_said_ = false, parameters_said_ = false;
  ShapeFile shape_;
};

}  // namespace

Result<ShapeFile> ReadObj(std::string_view bytes, const std::string& name) {
  return ObjReader(bytes, name).Read();
}

}  // namespace fjord::formats
