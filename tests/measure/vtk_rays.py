"""Runs bench_vtk.py with its options; beside the window's picture, --png FILE, goes what the rays of VTK's CPU mapper made, as
FILE.npy: rows from the top, 0 to 1, RGBA. The window moves it by a part of a pixel and interpolates, which has nothing to
do with steps. Usage: vtk_rays.py BENCH_VTK OPTIONS"""
import ctypes, runpy, sys
import numpy as np
import vtk

mapper = None


class Mapper(vtk.vtkFixedPointVolumeRayCastMapper):
    def __init__(self):
        global mapper
        mapper = self


class Writer(vtk.vtkPNGWriter):
    def Write(self):
        super().Write()
        rays = mapper.GetRayCastImage()
        width, height = rays.GetImageMemorySize()
        columns, rows = rays.GetImageInUseSize()
        left, bottom = rays.GetImageOrigin()
        pixels = ctypes.cast(int(rays.GetImage().split('_')[1], 16), ctypes.POINTER(ctypes.c_uint16))
        whole = np.zeros((*rays.GetImageViewportSize()[::-1], 4), np.float32)
        used = np.ctypeslib.as_array(pixels, (height, width, 4))[:rows, :columns]
        whole[bottom:bottom + rows, left:left + columns] = used / 32767.0  # 15 bits
        np.save(self.GetFileName() + '.npy', whole[::-1])


vtk.vtkFixedPointVolumeRayCastMapper, vtk.vtkPNGWriter = Mapper, Writer
sys.argv = sys.argv[1:]
runpy.run_path(sys.argv[0], run_name='__main__')
