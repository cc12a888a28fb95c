// Judges GLB files by the Khronos validator: node validate_glb.mjs FILE.glb ...
// Prints every error and warning; exit code 0 when there is none, 1 when there is one, 2 for wrong use.
// Needs `npm ci` in tests/ once.
import { readFile } from 'node:fs/promises';

import validator from 'gltf-validator';

const paths = process.argv.slice(2);
if (paths.length === 0) {
    console.error('usage: node validate_glb.mjs FILE.glb ...');
    process.exit(2);
}

const kSeverityNames = ['error', 'warning'];
let problems = 0;
for (const path of paths) {
    const bytes = await readFile(path);
    let report;
    try {
        report = await validator.validateBytes(new Uint8Array(bytes), { uri: path, maxIssues: 0 });
    } catch (problem) {
        console.error(`${path}: error: ${problem}`);
        ++problems;
        continue;
    }
    const serious = report.issues.messages.filter(({ severity }) => severity < kSeverityNames.length);
    for (const { severity, code, message, pointer } of serious.slice(0, 20))
        console.error(`${path}: ${kSeverityNames[severity]} ${code} at ${pointer ?? 'the file'}: ${message}`);
    if (serious.length > 20) console.error(`${path}: and ${serious.length - 20} more`);
    const { totalVertexCount, totalTriangleCount, animationCount, hasMorphTargets } = report.info;
    console.log(
        `${path}: ${report.mimeType}, ${totalVertexCount} vertices, ${totalTriangleCount} triangles, ` +
            `${animationCount} animations, morph targets: ${hasMorphTargets}; ` +
            `${report.issues.numErrors} errors, ${report.issues.numWarnings} warnings`,
    );
    if (report.mimeType !== 'model/gltf-binary') {
        console.error(`${path}: error: not a GLB file`);
        ++problems;
    }
    problems += report.issues.numErrors + report.issues.numWarnings;
}
process.exit(problems === 0 ? 0 : 1);
