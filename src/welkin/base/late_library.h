#pragma once

/// Libraries that are loaded when they are first needed.
namespace welkin {

/// A shared library that the program isn't linked with, because loading it and all that it brings along costs
/// every process milliseconds. It stays loaded until the process ends. To be kept in a function's static
/// variable, which makes loading safe among threads and lets it be tried again after a failure.
class LateLibrary {
 public:
  /// `file` is called as the system's loader finds it, `libheif.so.1`; `package` is the package of Debian
  /// that holds it, `purpose` what it is for, `reads such files`. Throws Error (unsupported), without the
  /// name of a picture's file.
  LateLibrary(const char* file, const char* package, const char* purpose);

  /// The library's function `name`. Throws Error (unsupported) where it has none.
  template <class Function>
  void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(address_of(name));
  }

 private:
  void* address_of(const char* name) const;

  const char* file_;
  const char* package_;
  void* handle_;
};

}  // namespace welkin
