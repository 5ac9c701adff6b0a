import numpy as np
import pytest

from rtb_addon.errors import RenderingError
from rtb_addon.renderers.ply import read_mesh, write_mesh
from rtb_addon.scene.render_scene import Mesh


def mesh(normals=True, uvs=True, seed=1):
    random = np.random.default_rng(seed)
    return Mesh(
        vertices=random.normal(size=(5, 3)).astype(np.float32),
        triangles=np.array([[0, 1, 2], [2, 3, 4]], np.int32),
        normals=random.normal(size=(5, 3)).astype(np.float32) if normals else None,
        uvs=random.uniform(size=(5, 2)).astype(np.float32) if uvs else None,
    )


@pytest.mark.parametrize("normals", [True, False])
@pytest.mark.parametrize("uvs", [True, False])
def test_meshes_survive_writing_and_reading_bit_for_bit(tmp_path, normals, uvs):
    written = mesh(normals, uvs)
    read = read_mesh(write_mesh(written, tmp_path))
    assert read.digest == written.digest
    assert (read.normals is None, read.uvs is None) == (not normals, not uvs)


def test_equal_meshes_share_one_file_that_is_written_once(tmp_path):
    first = write_mesh(mesh(), tmp_path)
    before = first.stat().st_mtime_ns
    assert write_mesh(mesh(), tmp_path) == first
    assert first.stat().st_mtime_ns == before
    assert write_mesh(mesh(seed=2), tmp_path) != first
    assert len(list((tmp_path / "meshes").iterdir())) == 2


def test_a_shortened_file_is_reported_in_one_sentence(tmp_path):
    path = write_mesh(mesh(), tmp_path)
    path.write_bytes(path.read_bytes()[:-3])
    with pytest.raises(RenderingError, match="is damaged, remove it"):
        read_mesh(path)


def test_a_file_that_is_no_mesh_is_reported_in_one_sentence(tmp_path):
    path = tmp_path / "stranger.ply"
    path.write_bytes(b"hello")
    with pytest.raises(RenderingError, match="counts no vertex"):
        read_mesh(path)
