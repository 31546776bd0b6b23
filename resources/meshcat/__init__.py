"""The viewer of meshcat 0.3.2.

It is as that package ships it, with its licences and those inside it.
"""
