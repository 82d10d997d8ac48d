"""A Blender scene with one white mesh, the league's camera and a white world."""

import math

import bpy
from common import done
from mathutils import Matrix


def prepare(model, camera):
    """The scene and the mesh's object, read by Blender's own importer with the file's axes kept."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.wm.obj_import(filepath=model, forward_axis="Y", up_axis="Z")
    mesh = bpy.context.selected_objects[0]
    white = bpy.data.materials.new("white")
    white.use_nodes = True
    nodes = white.node_tree.nodes
    nodes.clear()
    emission, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    white.node_tree.links.new(emission.outputs[0], output.inputs[0])
    mesh.data.materials.clear()
    mesh.data.materials.append(white)
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
    scene.world = world
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit = "VERTICAL"
    lens.angle = math.radians(camera["fov_y_degrees"])
    lens.clip_start, lens.clip_end = camera["near"], camera["far"]
    eye = bpy.data.objects.new("camera", lens)
    eye.matrix_world = Matrix(camera["view_from_world"]).inverted()
    scene.collection.objects.link(eye)
    scene.camera = eye
    scene.render.resolution_x = scene.render.resolution_y = camera["size"]
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "PNG"
    return scene, mesh


def finish(what, since):
    """The last line."""
    done(f"Blender {bpy.app.version_string}", what, since)
