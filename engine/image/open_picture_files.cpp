#include <dlfcn.h>

#include <filesystem>

#include "engine/base/fpenv.h"
#include "engine/image/picture_files.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;

constexpr char kModule[] = "fjord_picture_files.so";
// From the program's folder: installed; built, for programs and for tests.
constexpr const char* kFolders[] = {"../lib/fjord", "../engine/image", "../../engine/image"};

Result<const PictureFiles*> Open() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  std::string tried;
  for (const char* folder : kFolders) {
    const fs::path path = (program.parent_path() / folder / kModule).lexically_normal();
    tried += (tried.empty() ? "" : ", ") + path.string();
    if (!fs::exists(path, none)) continue;
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    SetFloatEnvironment();
    void* entry = module == nullptr ? nullptr : dlsym(module, "FjordPictureFiles3");
    if (entry == nullptr) {
      const char* why = dlerror();
      return MakeError(ErrorCode::kInternal,
                       std::string("cannot be used (") + (why == nullptr ? "no reason" : why) +
                           "); install Fjord anew",
                       Place{path.string()});
    }
    return reinterpret_cast<decltype(&FjordPictureFiles3)>(entry)();
  }
  return MakeError(ErrorCode::kInternal, std::string(kModule) +
                                             ", which reads and writes pictures, is not there; "
                                             "install Fjord anew. Looked for: " +
                                             tried);
}

}  // namespace

Result<const PictureFiles*> OpenPictureFiles() {
  static const Result<const PictureFiles*> kOpened = Open();
  return kOpened;
}

}  // namespace fjord
