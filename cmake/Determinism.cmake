# One picture on every machine (docs/determinism.md). Floating point is a property of the build:
# no contraction, no errno from sqrt, and the flags that would break exactness are refused.
foreach(flags CMAKE_CXX_FLAGS CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE})
  if("${${flags}}" MATCHES "-ffast-math|-Ofast|-march=native|-ffp-contract=(fast|on)|-funsafe-math")
    message(FATAL_ERROR "${flags} holds '${CMAKE_MATCH_0}', which would change pictures between builds")
  endif()
endforeach()
add_compile_options(-ffp-contract=off -fno-math-errno -fno-fast-math)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i.86)$")
  add_compile_options(-msse2 -mfpmath=sse)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Highway marks NEON code +crypto; g++ leaves the mark off constructors that it makes itself, and then
  # cannot inline them. Marking everything brings the two together; no compiler makes AES by itself.
  add_compile_options(-march=armv8-a+crypto)
endif()
