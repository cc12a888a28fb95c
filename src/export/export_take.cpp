#include "export/export_take.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "export/glb.h"
#include "export/mesh_to_export.h"
#include "export/obj.h"
#include "export/ply.h"
#include "take/whole_file.h"

namespace windfall::export_ {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;

std::string extension(ExportFormat format) {
    return "." + export_format_names()[static_cast<std::size_t>(format)];
}

// One file: a mesh at one frame, or at all of them.
struct Job {
    std::size_t mesh = 0;
    int first_frame = 0;
    int last_frame = 0;
    fs::path path;
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

std::vector<Job> plan_jobs(const take::TakeReader& take, const ExportOptions& options) {
    const std::string suffix = extension(options.format);
    const bool to_file = options.output.extension() == suffix;
    const bool animated = !options.frame && options.format == ExportFormat::Glb;
    const int first = options.frame.value_or(0), last = options.frame.value_or(take.frame_count() - 1);
    const fs::path folder = to_file ? options.output.parent_path() : options.output;
    const std::string stem = to_file ? options.output.stem().string() : file_stem(take.info().name);
    const bool numbered = !animated && !(to_file && options.frame);

    std::vector<Job> jobs;
    for (std::size_t m = 0; m < take.meshes().size(); ++m) {
        const std::string mesh = take.meshes().size() > 1 ? "_" + take.meshes()[m].name : "";
        for (int frame = first; frame <= (animated ? first : last); ++frame)
            jobs.push_back(
                {m, frame, animated ? last : frame,
                 folder / (stem + mesh + (numbered ? fmt::format("_{:04}", frame) : "") + suffix)});
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

const take::FrameMesh& mesh_of(const take::Frame& frame, const std::string& name) {
    for (const auto& mesh : frame.meshes)
        if (mesh.name == name) return mesh;
    throw InputError(fmt::format("frame {} has no mesh '{}'; make the take again", frame.index, name));
}

std::vector<Vec3> in_metres(const take::FrameMesh& mesh, double metres, int frame) {
    std::vector<Vec3> positions;
    positions.reserve(mesh.positions.size());
    for (const auto& p : mesh.positions) {
        positions.emplace_back(metres * p.cast<double>());
        if (!positions.back().allFinite())
            throw InputError(fmt::format(
                "frame {} has vertices that are nowhere (not a number); make the take again", frame));
    }
    return positions;
}

// A vertex without area around it has no normal, and formats want unit vectors.
std::vector<Vec3> unit_normals(const std::vector<Vec3>& positions, const std::vector<geometry::Face>& faces) {
    auto normals = geometry::vertex_normals(positions, faces);
    for (Vec3& normal : normals)
        if (!(std::abs(normal.norm() - 1) < 1e-6)) normal = Vec3::UnitY();
    return normals;
}

MeshToExport mesh_to_export(const take::TakeMesh& fresh, const take::Frame& frame, double metres) {
    const auto& moved = mesh_of(frame, fresh.name);
    MeshToExport mesh;
    mesh.name = fresh.name;
    mesh.positions = in_metres(moved, metres, frame.index);
    mesh.normals = unit_normals(mesh.positions, fresh.rest.faces);
    mesh.faces = fresh.rest.faces;
    mesh.corner_uvs = fresh.rest.corner_uvs;
    mesh.attributes = fresh.attributes;
    mesh.attributes.insert(mesh.attributes.end(), moved.attributes.begin(), moved.attributes.end());
    return mesh;
}

std::vector<Eigen::Vector3f> to_floats(const std::vector<Vec3>& vectors) {
    std::vector<Eigen::Vector3f> floats;
    for (const Vec3& v : vectors) floats.emplace_back(v.cast<float>());
    return floats;
}

double linear_from_srgb(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

// The plain part of a take's look; a look without these keys leaves a neutral grey.
ExportMaterial material_of(const nlohmann::json& look) {
    ExportMaterial material;
    if (!look.is_object()) return material;
    const auto colour = look.find("look.dry_colour");
    if (colour != look.end() && colour->is_array() && colour->size() == 3)
        for (std::size_t k = 0; k < 3; ++k)
            if ((*colour)[k].is_number())
                material.base_colour[k] = std::clamp(linear_from_srgb((*colour)[k].get<double>()), 0.0, 1.0);
    const auto roughness = look.find("look.roughness");
    if (roughness != look.end() && roughness->is_number())
        material.roughness = std::clamp(roughness->get<double>(), 0.0, 1.0);
    return material;
}

std::vector<std::byte> file_bytes(const take::TakeReader& take, const Job& job, const ExportOptions& options,
                                  const RunContext& context) {
    const double metres = take.info().unit_length_m * options.scale;
    const auto& fresh = take.meshes()[job.mesh];
    MeshToExport mesh = mesh_to_export(fresh, take.frame(job.first_frame), metres);
    if (options.format == ExportFormat::Ply) return ply_bytes(mesh);
    if (options.format == ExportFormat::Obj) {
        const std::string text = obj_text(mesh);
        const auto bytes = std::as_bytes(std::span(text));
        return {bytes.begin(), bytes.end()};
    }
    std::vector<MorphShape> later_frames;
    for (int index = job.first_frame + 1; index <= job.last_frame; ++index) {
        context.throw_if_cancelled();
        context.progress({"export", static_cast<double>(index), static_cast<double>(job.last_frame + 1), -1,
                          job.path.filename().string()});
        const auto positions = in_metres(mesh_of(take.frame(index), fresh.name), metres, index);
        later_frames.push_back({to_floats(positions), to_floats(unit_normals(positions, mesh.faces))});
    }
    // Attributes of the first frame would be wrong in all the others, and morph targets cannot carry them.
    if (!later_frames.empty()) mesh.attributes = fresh.attributes;
    return glb_bytes(mesh, material_of(take.info().look), later_frames, options.frames_per_second);
}

}  // namespace

const std::vector<std::string>& export_format_names() {
    static const std::vector<std::string> names = {"obj", "ply", "glb"};
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
