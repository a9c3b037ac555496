#pragma once
#include <catch2/catch.hpp>
#include <string>

#include "common/error.hpp"

namespace chute::test {

/// What InputError says; fails if nothing is thrown.
template <class Work>
std::string complaint(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  FAIL("no InputError");
  return "";
}

}  // namespace chute::test
