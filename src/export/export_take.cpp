#include "export/export_take.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "export/curves_to_export.h"
#include "export/glb.h"
#include "export/maps.h"
#include "export/meshes_of_take.h"
#include "export/obj.h"
#include "export/ply.h"
#include "take/whole_file.h"

namespace windfall::export_ {
namespace {

namespace fs = std::filesystem;

std::string extension(ExportFormat format) {
    return "." + export_format_names()[static_cast<std::size_t>(format)];
}

// One file: the meshes at one frame, or at all of them.
struct Job {
    int first_frame = 0;
    int last_frame = 0;
    fs::path path;
    std::string material_file = {};  // OBJ: the file with the materials, beside it
    bool is_material_file = false;
    bool is_hair_file = false;  // PLY: the hair, beside the meshes
};

void check(const take::TakeReader& take, const ExportOptions& options) {
    if (!(options.scale > 0) || !std::isfinite(options.scale))
        throw InputError(fmt::format("--scale must be a number > 0, not {}", options.scale));
    if (!(options.frames_per_second > 0) || !std::isfinite(options.frames_per_second))
        throw InputError(fmt::format("--fps must be a number > 0, not {}", options.frames_per_second));
    if (options.output.empty()) throw InputError("no place to export to; give a file or a folder with -o");
    for (const auto& name : export_format_names())
        if (const std::string suffix = "." + name;
            suffix != extension(options.format) && options.output.extension() == suffix)
            throw InputError(fmt::format("{} does not end in {}; change the name, or the format to --to {}",
                                         options.output.string(), extension(options.format), name));
    const std::string folder = take.folder().string();
    if (take.frame_count() == 0 || take.meshes().empty())
        throw InputError(fmt::format("{} has no frames yet; let its run go on with --resume", folder));
    if (options.frame && (*options.frame < 0 || *options.frame >= take.frame_count()))
        throw InputError(fmt::format("{} has the frames 0 to {}, so --frame {} cannot be exported", folder,
                                     take.frame_count() - 1, *options.frame));
}

// The take's name may hold anything; a file name may not.
std::string file_stem(const std::string& name) {
    std::string stem = name.empty() ? "take" : name;
    std::replace_if(
        stem.begin(), stem.end(), [](char c) { return c == '/' || static_cast<unsigned char>(c) < ' '; },
        '_');
    if (stem.front() == '.') stem.front() = '_';
    return stem;
}

// A take has hair when its last frame has, where the most of it is.
bool has_hair(const take::TakeReader& take, const ExportOptions& options) {
    take::Frame frame = take.frame(options.frame.value_or(take.frame_count() - 1));
    if (options.dress) options.dress(frame);
    return !frame.curves.empty();
}

std::vector<Job> plan_jobs(const take::TakeReader& take, const ExportOptions& options) {
    const std::string suffix = extension(options.format);
    const bool to_file = options.output.extension() == suffix;
    const bool animated = !options.frame && options.format == ExportFormat::Glb;
    const int first = options.frame.value_or(0), last = options.frame.value_or(take.frame_count() - 1);
    const fs::path folder = to_file ? options.output.parent_path() : options.output;
    const std::string stem = to_file ? options.output.stem().string() : file_stem(take.info().name);
    const bool numbered = !animated && !(to_file && options.frame);

    const bool has_materials = std::any_of(take.meshes().begin(), take.meshes().end(),
                                           [](const auto& mesh) { return !mesh.materials.empty(); });
    std::vector<Job> jobs;
    std::string material_file;
    if (options.format == ExportFormat::Obj && has_materials) {
        material_file = stem + ".mtl";  // one for all frames
        jobs.push_back({first, first, folder / material_file, "", true});
    }
    const bool hair_files = options.format == ExportFormat::Ply && has_hair(take, options);
    for (int frame = first; frame <= (animated ? first : last); ++frame) {
        const std::string name = stem + (numbered ? fmt::format("_{:04}", frame) : "");
        jobs.push_back({frame, animated ? last : frame, folder / (name + suffix), material_file});
        if (hair_files) jobs.push_back({frame, frame, folder / (name + "_hair" + suffix), "", false, true});
    }
    return jobs;
}

void check_free(const std::vector<Job>& jobs, bool overwrite) {
    for (const auto& job : jobs) {
        std::error_code problem;
        if (fs::is_directory(job.path, problem))
            throw InputError(fmt::format("{} is a folder; choose another name with -o", job.path.string()));
        if (!overwrite && fs::exists(job.path, problem))
            throw InputError(
                fmt::format("{} is there already; add --force to replace it, or choose another name "
                            "with -o",
                            job.path.string()));
    }
}

std::vector<std::byte> bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// All meshes with their ways through the frames of a job.
std::vector<MeshToAnimate> animated_meshes(const take::TakeReader& take, std::vector<MeshToExport> meshes,
                                           const Job& job, double metres, const RunContext& context) {
    std::vector<MeshToAnimate> animated(meshes.size());
    for (int index = job.first_frame + 1; index <= job.last_frame; ++index) {
        context.throw_if_cancelled();
        context.progress({"export", static_cast<double>(index), static_cast<double>(job.last_frame + 1), -1,
                          job.path.filename().string()});
        auto shapes = shapes_at(meshes, take.frame_without_map_values(index), metres);
        for (std::size_t m = 0; m < shapes.size(); ++m)
            animated[m].later_frames.push_back(std::move(shapes[m]));
    }
    // Attributes of the first frame would be wrong in all the others, and morph targets cannot carry them.
    if (job.last_frame > job.first_frame) keep_constant_attributes(take, meshes);
    for (std::size_t m = 0; m < meshes.size(); ++m) animated[m].mesh = std::move(meshes[m]);
    return animated;
}

std::vector<std::byte> file_bytes(const take::TakeReader& take, const Job& job, const ExportOptions& options,
                                  const RunContext& context) {
    const double metres = take.info().unit_length_m * options.scale;
    const bool animated = job.last_frame > job.first_frame;
    take::Frame frame = options.dress && !animated ? take.frame(job.first_frame)
                                                   : take.frame_without_map_values(job.first_frame);
    if (options.dress && !animated) options.dress(frame);
    const auto curves = animated ? std::vector<CurvesToExport>() : curves_at(frame, metres);
    if (job.is_hair_file) return curves_ply_bytes(curves);
    auto meshes = meshes_at(take, frame, metres);
    if (meshes.empty()) throw InputError(fmt::format("{} has no faces to export", take.folder().string()));
    if (job.is_material_file) return bytes_of(mtl_text(meshes));
    switch (options.format) {
        case ExportFormat::Obj:
            return bytes_of(obj_text(meshes, job.material_file, curves));
        case ExportFormat::Ply:
            return ply_bytes(meshes);
        case ExportFormat::Glb:
        case ExportFormat::Maps:
            break;
    }
    return glb_bytes(animated_meshes(take, std::move(meshes), job, metres, context),
                     options.frames_per_second, curves);
}

}  // namespace

const std::vector<std::string>& export_format_names() {
    static const std::vector<std::string> names = {"obj", "ply", "glb", "maps"};
    return names;
}

ExportFormat export_format(const std::string& name) {
    const auto& names = export_format_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw InputError(fmt::format("'{}' is no export format; there are {}", name, fmt::join(names, ", ")));
    return static_cast<ExportFormat>(found - names.begin());
}

std::vector<fs::path> export_take(const take::TakeReader& take, const ExportOptions& options,
                                  const RunContext& context) {
    check(take, options);
    if (options.format == ExportFormat::Maps) return export_maps(take, options, context);
    const auto jobs = plan_jobs(take, options);
    check_free(jobs, options.overwrite);
    if (const fs::path folder = jobs.front().path.parent_path(); !folder.empty())
        take::make_writable_folder(folder);

    std::vector<fs::path> written;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        context.throw_if_cancelled();
        take::write_whole_file(jobs[i].path, file_bytes(take, jobs[i], options, context));
        written.push_back(jobs[i].path);
        context.progress({"export", static_cast<double>(i + 1), static_cast<double>(jobs.size()), -1,
                          jobs[i].path.filename().string()});
    }
    return written;
}

}  // namespace windfall::export_
