#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "myoid/cli/context.h"

namespace myoid::cli {

/// What a page with a moving model is made of, from the command line.
struct ModelPageOptions {
  std::string html;  ///< The page; empty: none is asked for.
  std::string motion, forces, activations, markers;
  std::string up = "y";
  std::vector<std::string> mesh_folders;
};

/// Adds --html, --motion, --forces, --activations, --markers, --meshes and --up.
void add_model_page_options(CLI::App& command, ModelPageOptions& options);

/// Writes the page and returns a sentence about it. `model` is a file or "arm4". Throws
/// InvalidInput or ReadError; nothing is written then.
std::string write_model_page(const std::string& model,
                             const ModelPageOptions& options,
                             const Context& context);

}  // namespace myoid::cli
