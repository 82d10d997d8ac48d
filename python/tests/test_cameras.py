"""Cameras: each is put as numbers that show points where its own formula does."""

import numpy as np
import pytest
import tinta_npr as tn


def ends(lines):
    return lines.segments.reshape(-1, 2)


def shows(lines, places):
    """Whether every one of these places is an end of a line, and no line leaves their box."""
    distances = np.linalg.norm(ends(lines)[None] - places[:, None], axis=2).min(axis=1)
    assert distances.max() < 1e-6, distances
    assert (ends(lines) > places.min(axis=0) - 1e-6).all() and (ends(lines) < places.max(axis=0) + 1e-6).all()


def rotation():
    forward = np.array([-0.3, -0.5, -0.9])
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, (0.1, 1.0, 0.0))
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(forward, right), forward])


def projected(matrix, points):
    homogeneous = np.column_stack([points, np.ones(len(points))]) @ matrix.T
    return homogeneous[:, :2] / homogeneous[:, 2:]


@pytest.mark.parametrize(
    "inner",
    [
        [[500, 0, 200], [0, 500, 150], [0, 0, 1]],
        [[500, 0, 170], [0, 500, 160], [0, 0, 1]],
        [[450, 7, 210], [0, 520, 140], [0, 0, 1]],
    ],
    ids=["in the middle", "off the middle", "oblong and skew"],
)
def test_a_matrix_from_world_to_pixels(cube, inner):
    vertices, faces = cube
    eye = np.array([1.6, 2.1, 3.9])
    matrix = np.array(inner, float) @ rotation() @ np.column_stack([np.eye(3), -eye])
    for scale in (1.0, 7.5):
        lines = tn.lines(vertices, faces, camera=scale * matrix, size=(400, 300), classes="all", crease_angle=5)
        shows(lines, projected(matrix, vertices))
        assert lines.visible.sum() >= 9


@pytest.mark.parametrize("stretch", [(100, 100, 0), (100, 80, 3)], ids=["square", "oblong and skew"])
def test_a_parallel_matrix(cube, stretch):
    vertices, faces = cube
    across, down, skew = stretch
    matrix = np.zeros((3, 4))
    matrix[:2, :3] = np.array([[across, skew], [0, down]]) @ rotation()[:2]
    matrix[:, 3] = 180, 200, 1
    lines = tn.lines(vertices, faces, camera=matrix, size=(400, 300), classes="all", crease_angle=5)
    shows(lines, projected(matrix, vertices))
    assert "height" in lines.camera


def test_a_matrix_to_clip_space_is_opengls(cube):
    vertices, faces = cube
    lines = tn.lines(vertices, faces, size=(320, 200), eye=(3, 2, 4), target=(0.4, 0.5, 0.6), fov=35)
    view = np.eye(4)
    back = np.subtract((3, 2, 4), (0.4, 0.5, 0.6))
    back /= np.linalg.norm(back)
    right = np.cross((0, 1, 0), back)
    right /= np.linalg.norm(right)
    view[:3, :3] = right, np.cross(back, right), back
    view[:3, 3] = -view[:3, :3] @ (3, 2, 4)
    near, far, focal = 0.5, 20.0, 1 / np.tan(np.radians(35 / 2))
    clip = np.zeros((4, 4))
    clip[0, 0], clip[1, 1], clip[3, 2] = focal * 200 / 320, focal, -1
    clip[2, 2:] = (far + near) / (near - far), 2 * far * near / (near - far)
    again = tn.lines(vertices, faces, size=(320, 200), camera=clip @ view)
    assert again.segments.shape == lines.segments.shape
    assert np.abs(again.segments - lines.segments).max() < 1e-6
    # And in pictures: the same eye to the last bits of a number.
    ours = tn.render(vertices, faces, size=(320, 200), style="inking", eye=(3, 2, 4), target=(0.4, 0.5, 0.6), fov=35)
    theirs = tn.render(vertices, faces, size=(320, 200), style="inking", camera=clip @ view)
    assert (ours != theirs).any(axis=2).mean() < 0.001


def test_what_is_given_by_name_or_dictionary(cube):
    same = [
        tn.lines(*cube, view="iso"),
        tn.lines(*cube, camera="iso"),
        tn.lines(*cube, camera={"view": "iso"}),
        tn.lines(*cube, camera=(45, 35.264389682754654)),
    ]
    assert len({lines.svg() for lines in same}) == 1
    lines = tn.lines(*cube, camera=[(3, 3, 3), (0, 0, 0), (0, 1, 0)])
    assert np.allclose(lines.camera["eye"], 3) and "fov" in lines.camera
    # What lines say of their camera is a camera.
    assert tn.lines(*cube, camera=lines.camera).svg() == lines.svg()
